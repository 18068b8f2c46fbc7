// A real device of one or two axes that speaks docs/hid-protocol.md, as the Impulse Engine 2000
// behind its adapter, or a dialect (docs/dialects.md).
//
// Three threads serve it. The owner lists, opens and closes; after a loss it retries every 50 ms,
// doubled up to 1 s. The reader waits for reports and keeps the newest. The writer sends the newest
// force and may block. The loop (read, write, enable, link) only exchanges values with them.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "device/device.h"
#include "device/link/link.h"
#include "device/link/link_loop.h"
#include "device/link/port.h"

namespace hapticwall::device {

class LinkMachine;

class ImpulseEngine : public Device {
 public:
  // The owner's thread calls `open_port` at every open(). Realtime-safe: no.
  ImpulseEngine(ImpulseEngineOptions options, hid::PortOpener open_port, HostClock now_ns);
  ~ImpulseEngine() override;

  // Name, and after open() the encoder and force limit of axis x. Any thread. Realtime-safe: no.
  [[nodiscard]] DeviceInfo info() const override;

  // Finds the device and waits for its first position, at most five seconds. Fails with
  // ErrorKind::kDevice. Realtime-safe: no.
  [[nodiscard]] Failure open() override;

  // Axis x. Reads as a fault during any trouble, and once after a link that was lost and came back
  // between two reads. Realtime-safe: yes.
  [[nodiscard]] DeviceReading read() override;
  // Axis x; y gets no force. Nothing leaves while closed. If the link is slower, the newest force
  // wins. Realtime-safe: yes (it wakes the writer without waiting for it).
  void write(double force_n) override;

  // Reading and writing of both axes, instead of read() and write(). Realtime-safe: yes.
  [[nodiscard]] AxesReading read_axes();
  void write_axes(const AxisValues& force_n);

  // Takes effect with the next write. After any trouble the force stays off until enable(false)
  // and enable(true) follow. While disabled, the link clears faults whose causes have gone.
  // Realtime-safe: yes.
  void enable(bool enabled) override;
  [[nodiscard]] LinkStats link() const override;

  // Removes the force, then joins the threads; a blocked write is left to end by itself. Takes at
  // most about a second. Realtime-safe: no.
  void close() override;

  [[nodiscard]] std::string trouble_details() const override;

 private:
  [[nodiscard]] std::shared_ptr<LinkMachine> machine() const;
  void set_machine(std::shared_ptr<LinkMachine> machine);

  ImpulseEngineOptions options_;
  hid::PortOpener open_port_;
  HostClock now_ns_;
  // nullptr: not open. Changed under the mutex, by the thread that calls open() and close().
  std::shared_ptr<LinkMachine> machine_;
  mutable std::mutex machine_mutex_;
};

// Engine on the system's port and clock.
[[nodiscard]] std::unique_ptr<ImpulseEngine> make_impulse_engine(
    const ImpulseEngineOptions& options);
// Engine on another port, which every open() uses.
[[nodiscard]] std::unique_ptr<ImpulseEngine> make_impulse_engine(
    const ImpulseEngineOptions& options, std::unique_ptr<hid::Port> port, HostClock now_ns);

}  // namespace hapticwall::device
