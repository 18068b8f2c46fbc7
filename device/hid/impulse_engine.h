// A real device that speaks docs/hid-protocol.md: the Impulse Engine 2000 behind its adapter, or
// any other of one or two axes.
//
// Three threads of its own beside the loop. The owner lists, opens and closes, and looks again
// after a loss (50 ms, doubled up to 1 s); the reader waits for reports and drains to the newest;
// the writer sends the newest force, for which it may wait long. The loop's side (read, write,
// enable, link) only exchanges values with them.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "device/device.h"
#include "device/hid_port.h"
#include "device/link_loop.h"
#include "device/link_options.h"

namespace hapticwall::device {

class LinkMachine;

class ImpulseEngine : public Device {
 public:
  // `open_port` is called on the owner's thread at every open(). Realtime-safe: no.
  ImpulseEngine(ImpulseEngineOptions options, hid::PortOpener open_port, HostClock now_ns);
  ~ImpulseEngine() override;

  // Name, and after open() the figures of axis x. Any thread. Realtime-safe: no.
  [[nodiscard]] DeviceInfo info() const override;

  // Looks for the device and waits until its first position is there: three seconds at most. Fails
  // with one sentence (ErrorKind::kDevice). Realtime-safe: no.
  [[nodiscard]] Failure open() override;

  // Axis x. A fault while any trouble lasts, and for one reading after a link that came back
  // unseen. Realtime-safe: yes.
  [[nodiscard]] DeviceReading read() override;
  // Axis x; no force on y. Not faster than the link: the newest force wins. Realtime-safe: yes (it
  // wakes the writer, which does not wait).
  void write(double force_n) override;

  // Both axes, in the place of read() and write(). Realtime-safe: yes.
  [[nodiscard]] AxesReading read_axes();
  void write_axes(const AxisValues& force_n);

  // Holds from the next write on. After any trouble the force stays off until it was asked for
  // anew: enable(false), then enable(true). While it is off, faults whose causes have gone are
  // cleared. Realtime-safe: yes.
  void enable(bool enabled) override;
  [[nodiscard]] LinkFigures link() const override;

  // The force is taken away, then everything is joined; what a blocked write still holds is left to
  // end by itself. At most about a second. Realtime-safe: no.
  void close() override;

  [[nodiscard]] std::string trouble_details() const override;

 private:
  [[nodiscard]] std::shared_ptr<LinkMachine> machine() const;
  void set_machine(std::shared_ptr<LinkMachine> machine);

  ImpulseEngineOptions options_;
  hid::PortOpener open_port_;
  HostClock now_ns_;
  // nullptr: not open. Changed under the mutex, by the thread that the loop's side belongs to then.
  std::shared_ptr<LinkMachine> machine_;
  mutable std::mutex machine_mutex_;
};

// Opens the system's own port and clock.
[[nodiscard]] std::unique_ptr<ImpulseEngine> make_impulse_engine(
    const ImpulseEngineOptions& options);
// The same on another port, which every open() uses.
[[nodiscard]] std::unique_ptr<ImpulseEngine> make_impulse_engine(
    const ImpulseEngineOptions& options, std::unique_ptr<hid::Port> port, HostClock now_ns);

}  // namespace hapticwall::device
