#include "app/session/loop/loop_axis.h"

namespace hapticwall::session {
void LoopAxis::apply(const ServoSettings& settings, PlantModel* new_plant) {
  servo.apply(settings);
  if (new_plant == plant || new_plant == nullptr) return;
  plant = new_plant;
  device.change_plant(*plant);
}

void LoopAxis::reset() {
  device.reset();
  servo.reset();
}

Sample LoopAxis::at_rest() {
  Sample sample;
  sample.position_m = device.read().position_m;
  sample.penetration_m =
      evaluate_walls(servo.settings().walls, sample.position_m, 0.0).penetration_m;
  if (const PlantTruth* truth = device.truth()) sample.truth = *truth;
  return sample;
}

ReadDevice LoopAxis::read(double elapsed_s, double gain, bool armed) {
  servo.state().force_gain = gain;
  device.enable(armed);
  ReadDevice read{device, device.read()};
  if (judge) judge_reading(read.reading, elapsed_s, armed);
  return read;
}

void LoopAxis::judge_reading(DeviceReading& reading, double elapsed_s, bool armed) {
  ServoState& state = servo.state();
  judged = judge->judge(reading, device.link(),
                        {elapsed_s, state.previous_force_n, servo.settings().force_limit_n, armed});
  const bool impossible = judged == ArmingNote::kImplausible || judged == ArmingNote::kAcceleration;
  if (impossible) reading.state = DeviceState::kFault;
  state.limit_share = judge->obedience().limit_share();
  state.level = judge->obedience().level();
  if (judged == ArmingNote::kNone) return;
  state.force_gain = 0.0;
  device.enable(false);
}

}  // namespace hapticwall::session
