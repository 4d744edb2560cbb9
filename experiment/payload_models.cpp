#include "experiment/payload_models.hpp"

#include "response/time/time_model.hpp"

#include <algorithm>
#include <utility>

namespace flexarm::experiment {

int PayloadModel::modes() const {
  const int kept = std::min(requested_modes, static_cast<int>(model.modes.size()) - 1);
  const int degrees_of_freedom = response::degrees_of_freedom(chosen.formulation);
  return degrees_of_freedom > 0 ? std::min(kept, degrees_of_freedom - 1) : kept;
}

const PayloadModel& PayloadModels::of(const std::optional<arm::Payload>& payload, int modes) {
  arm::Arm loaded = arm_;
  loaded.payload = payload.value_or(arm_.payload);
  const auto known = std::ranges::find_if(models_, [&](const PayloadModel& model) {
    return model.payload == loaded.payload && model.requested_modes == modes;
  });
  if (known != models_.end()) return *known;
  response::ArmParts parts = response::take_apart(loaded);
  auto chosen = formulation_.make(parts.linear, modes + (static_correction_ ? 1 : 0));
  auto model = response::time_model(chosen.formulation, parts, modes, sensors_, static_correction_);
  models_.push_back(
      {loaded.payload, modes, std::move(parts), std::move(chosen), std::move(model)});
  return models_.back();
}

}  // namespace flexarm::experiment
