#include "report/figures/overlay_figure.hpp"

#include "diagnose/observations.hpp"
#include "measured/spectra/robust.hpp"
#include "report/figures/meaning.hpp"
#include "report/figures/sensor_label.hpp"
#include "report/largest_stretch.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace flexarm::report {

namespace {

using diagnose::Diagnosis;
using diagnose::Experiment;
using diagnose::Overlay;

constexpr int kSignal_px = 175;
constexpr int kResidual_px = 150;  // with its note
constexpr int kTorque_px = 110;
constexpr int kOverlayFurniture_px = 110;
constexpr int kOverlayWidth_px = 1000;
constexpr int kLensWidth_px = 550;

/// A predicted signal of a run, with its NRMSE.
struct PredictedSignal {
  const Overlay* overlay = nullptr;
  diagnose::Gain error;

  bool is_of_hub() const {
    return overlay->sensor == "hub_angle" || overlay->sensor == "hub_velocity";
  }
  std::string unit() const {
    return overlay->sensor == diagnose::kTorqueChannel
               ? "N m"
               : axis_unit(arm::parse_sensor(overlay->sensor));
  }
};

/// The worst of the hub and the worst of the others, the worse first.
std::vector<PredictedSignal> drawn_signals(const Diagnosis& diagnosis, std::size_t run,
                                           const std::string& id) {
  std::vector<PredictedSignal> all;
  for (const Overlay& overlay : diagnosis.overlays) {
    if (overlay.run != run) continue;
    const auto gain = std::ranges::find_if(diagnosis.channels, [&](const auto& channel) {
      return channel.run == id && channel.sensor == overlay.sensor;
    });
    all.push_back({&overlay, gain == diagnosis.channels.end() ? diagnose::Gain{} : gain->error});
  }
  std::ranges::stable_sort(all, std::greater(),
                           [](const PredictedSignal& signal) { return signal.error.before; });
  std::vector<PredictedSignal> drawn;
  for (const PredictedSignal& signal : all) {
    const bool is_first_of_kind = std::ranges::none_of(drawn, [&](const PredictedSignal& other) {
      return other.is_of_hub() == signal.is_of_hub();
    });
    if (is_first_of_kind) drawn.push_back(signal);
  }
  return drawn;
}

/// Where `kDrawnSamples` begin in which the residuals of the baseline are largest.
std::size_t worst_stretch(const std::vector<PredictedSignal>& signals, std::size_t samples) {
  std::vector<double> squares(samples);
  for (const PredictedSignal& signal : signals) {
    const Overlay& overlay = *signal.overlay;
    const double scale = measured::standard_deviation(overlay.measured);
    if (!(scale > 0.0)) continue;
    for (std::size_t k = 0; k < samples; ++k) {
      squares[k] += std::pow((overlay.measured[k] - overlay.before[k]) / scale, 2);
    }
  }
  return begin_of_largest_stretch(squares, kDrawnSamples);
}

struct Stretch {
  std::size_t from = 0;
  std::size_t to = 0;

  std::vector<double> of(const std::vector<double>& values) const {
    return {values.begin() + static_cast<std::ptrdiff_t>(from),
            values.begin() + static_cast<std::ptrdiff_t>(to)};
  }
};

const Style kMeasuredSignal{.colour = kMeasuredColour, .tint = 0.6, .line_width_px = 3.0};
const Style kBaselineSignal{.colour = kBaselineColour, .line_width_px = 1.1};
const Style kExtendedSignal{.colour = kIdentifiedColour, .line_width_px = 1.1};

Panel residual_panel(const PredictedSignal& signal, const Stretch& stretch,
                     const std::vector<double>& time_s, bool extended) {
  const Overlay& overlay = *signal.overlay;
  const std::vector<double> measured = stretch.of(overlay.measured);
  std::vector<double> residual = stretch.of(extended ? overlay.after : overlay.before);
  for (std::size_t k = 0; k < residual.size(); ++k) residual[k] = measured[k] - residual[k];
  const std::string name = extended ? kExtendedName : kBaselineName;
  Panel panel{.y = {.label = "residual", .unit = signal.unit(), .robust = true},
              .height = static_cast<double>(kResidual_px) / kSignal_px};
  panel.note = fmt::format("{}, NRMSE of the run {:.3g} % (noise floor {:.3g} %)", name,
                           100.0 * (extended ? signal.error.after : signal.error.before),
                           100.0 * signal.error.noise_floor);
  panel.series.push_back(
      {name, time_s, std::move(residual), extended ? kExtendedSignal : kBaselineSignal});
  return panel;
}

void add_panels(const PredictedSignal& signal, const Stretch& stretch,
                const std::vector<double>& time_s, bool has_extended, PanelStack& stack) {
  const Overlay& overlay = *signal.overlay;
  Panel panel{.y = {.label = in_words(overlay.sensor), .unit = signal.unit(), .robust = true}};
  panel.series.push_back({"measured", time_s, stretch.of(overlay.measured), kMeasuredSignal});
  panel.series.push_back({kBaselineName, time_s, stretch.of(overlay.before), kBaselineSignal});
  if (has_extended) {
    panel.series.push_back({kExtendedName, time_s, stretch.of(overlay.after), kExtendedSignal});
  }
  stack.panels.push_back(std::move(panel));
  stack.panels.push_back(residual_panel(signal, stretch, time_s, false));
  if (has_extended) stack.panels.push_back(residual_panel(signal, stretch, time_s, true));
}

/// The signals and the torque of a part of a run.
PanelStack stack_of(const measured::TimeRecord& record, const std::vector<PredictedSignal>& signals,
                    const Stretch& stretch, bool has_extended) {
  PanelStack stack{.x = {.label = "time", .unit = "s"}};
  const std::vector<double> time_s = stretch.of(record.time_s);
  for (const PredictedSignal& signal : signals) {
    add_panels(signal, stretch, time_s, has_extended, stack);
  }
  Panel torque{.y = {.label = "torque", .unit = "N m", .robust = true},
               .height = static_cast<double>(kTorque_px) / kSignal_px};
  torque.series.push_back(
      {"torque", time_s, stretch.of(record.torque_N_m), {.colour = kMeasuredColour}});
  torque.series.back().style.line_width_px = 1.0;
  stack.panels.push_back(std::move(torque));
  return stack;
}

}  // namespace

bool has_after(const Diagnosis& diagnosis) {
  return !diagnosis.causes.empty() || diagnosis.empirical_law || !diagnosis.refitted.empty();
}

std::optional<Figure> overlay_figure(const Experiment& experiment, const Diagnosis& diagnosis,
                                     std::size_t run) {
  const auto& [stated, data] = experiment.runs[run];
  const auto& record = std::get<measured::TimeRecord>(data);
  const auto& time_s = record.time_s;
  const auto signals = drawn_signals(diagnosis, run, stated.id);
  if (signals.empty()) return std::nullopt;
  std::size_t samples = time_s.size();
  for (const PredictedSignal& signal : signals) {
    samples = std::min(samples, signal.overlay->measured.size());
  }
  const bool has_extended = has_after(diagnosis);
  Figure figure;
  figure.title = stated.id;
  figure.width_px = kOverlayWidth_px;
  figure.height_px =
      kOverlayFurniture_px + kTorque_px +
      static_cast<int>(signals.size()) * (kSignal_px + kResidual_px * (has_extended ? 2 : 1));
  figure.stacks.push_back(stack_of(record, signals, {0, samples}, has_extended));
  if (samples <= kDrawnSamples) return figure;
  const std::size_t from = worst_stretch(signals, samples);
  const Stretch lens{from, from + kDrawnSamples};
  figure.title += fmt::format("; on the right {:.4g} to {:.4g} s, where residuals are largest",
                              time_s[lens.from], time_s[lens.to - 1]);
  figure.width_px += kLensWidth_px;
  figure.stacks.push_back(stack_of(record, signals, lens, has_extended));
  for (Panel& panel : figure.stacks.back().panels) {
    if (!panel.note.empty()) panel.note = " ";  // they are of the run; as much room as on the left
  }
  return figure;
}

}  // namespace flexarm::report
