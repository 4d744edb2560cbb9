#include "diagnose/predictors/modal_models.hpp"

#include "response/formulation_maker.hpp"
#include "response/time/time_model.hpp"

#include <algorithm>
#include <utility>

namespace flexarm::diagnose {

std::shared_ptr<const arm::ModalModel> ModalModels::of(const response::ArmParts& parts,
                                                       std::span<const arm::Sensor> sensors) {
  const auto computed = [&] {
    return std::make_shared<const arm::ModalModel>(response::time_model(
        response::formulation_of_fit(parts.linear), parts, flexible_modes_, sensors));
  };
  if (!arm::has_beam(parts.linear)) return computed();
  Entry wanted{.arm = arm::linear_arm(parts.linear),
               .placed = arm::placed(sensors, parts.linear),
               .has_beam_forces = !parts.beam_forces.empty()};
  {
    const std::lock_guard lock(mutex_);
    const auto found =
        std::ranges::find_if(entries_, [&](const Entry& entry) { return entry.is_same(wanted); });
    if (found != entries_.end()) {
      found->used = ++uses_;
      return found->model;
    }
  }
  wanted.model = computed();
  const std::lock_guard lock(mutex_);
  if (entries_.size() == kKept) {
    entries_.erase(std::ranges::min_element(entries_, {}, &Entry::used));
  }
  wanted.used = ++uses_;
  entries_.push_back(wanted);
  return wanted.model;
}

}  // namespace flexarm::diagnose
