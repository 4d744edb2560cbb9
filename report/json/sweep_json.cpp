#include "report/json/sweep_json.hpp"

#include "report/json/arm_json.hpp"
#include "report/json/json_document.hpp"
#include "report/tables/sweep_tables.hpp"

#include <cmath>
#include <string_view>

namespace flexarm::report {

namespace {

using Json = nlohmann::ordered_json;
using compare::SweepCurve;
using compare::SweepEvent;
using compare::SweepResult;

Json parameters_json(const SweepResult& result) {
  Json parameters = Json::array();
  for (const auto& axis : result.task.axes) {
    parameters.push_back({{"name", axis.parameter.name},
                          {"unit", axis.parameter.unit},
                          {"logarithmic", axis.logarithmic},
                          {"values", axis.values}});
  }
  return parameters;
}

Json models_json(const SweepResult& result) {
  Json models = Json::array();
  for (std::size_t m = 0; m < result.task.models.size(); ++m) {
    models.push_back({{"model", result.task.models[m].name},
                      {"settings", result.task.models[m].settings},
                      {"degrees_of_freedom", result.degrees_of_freedom[m]}});
  }
  return models;
}

Json poles_json(const SweepResult& result) {
  Json poles = Json::array();
  for (const SweepCurve& curve : result.curves) {
    if (curve.family != compare::SweepFamily{}) continue;
    const auto k = static_cast<std::size_t>(curve.number) - 1;
    Json entry = {{"order", curve.number}, {"values", Json::array()}};
    for (std::size_t m = 0; m < result.task.models.size(); ++m) {
      Json omega = Json::array();
      for (const auto& s : curve.s_rad_per_s[m]) omega.push_back(s ? s->imag() : NAN);
      Json values = {{"model", result.task.models[m].name}, {"omega_rad_per_s", std::move(omega)}};
      if (!result.modes.hub_slope.empty()) {
        values["hub_slope"] = result.modes.hub_slope[m][k];
        values["tip_value_m"] = result.modes.tip_value_m[m][k];
      }
      entry["values"].push_back(std::move(values));
    }
    poles.push_back(std::move(entry));
  }
  return poles;
}

/// The values of a track by every model.
Json track_json(const SweepResult& result, const SweepCurve& curve) {
  Json all = Json::array();
  for (std::size_t m = 0; m < result.task.models.size(); ++m) {
    Json re = Json::array();
    Json im = Json::array();
    Json damping = Json::array();
    for (const auto& s : curve.s_rad_per_s[m]) {
      // NaN becomes null in the document.
      re.push_back(s ? s->real() : NAN);
      im.push_back(s ? s->imag() : NAN);
      damping.push_back(s ? compare::damping_ratio(*s) : NAN);
    }
    Json values = {{"model", result.task.models[m].name},
                   {"re_rad_per_s", std::move(re)},
                   {"im_rad_per_s", std::move(im)}};
    if (curve.family.damped) values["damping_ratio"] = std::move(damping);
    all.push_back(std::move(values));
  }
  return all;
}

Json damped_poles_json(const SweepResult& result) {
  Json poles = Json::array();
  for (const SweepCurve& curve : result.curves) {
    if (!curve.family.damped) continue;
    poles.push_back({{"track", curve.number}, {"values", track_json(result, curve)}});
  }
  return poles;
}

Json zeros_json(const SweepResult& result) {
  Json zeros = Json::array();
  for (const SweepCurve& curve : result.curves) {
    if (!curve.family.zeros_of) continue;
    zeros.push_back({{"sensor", arm::to_string(*curve.family.zeros_of)},
                     {"track", curve.number},
                     {"values", track_json(result, curve)}});
  }
  return zeros;
}

/// The values of flexarm.sweep/1.
std::string_view json_name(SweepEvent::Kind kind) {
  switch (kind) {
    case SweepEvent::Kind::appears_beyond:
      return "comes from beyond";
    case SweepEvent::Kind::leaves_beyond:
      return "leaves beyond";
    case SweepEvent::Kind::appears:
      return "appears";
    case SweepEvent::Kind::vanishes:
      return "vanishes";
    case SweepEvent::Kind::meet:
      return "meets";
    case SweepEvent::Kind::part:
      return "parts from";
    case SweepEvent::Kind::ambiguous:
      return "not clear which is which";
    case SweepEvent::Kind::seam:
      return "does not fit the row before";
  }
  return "";
}

Json events_json(const SweepResult& result) {
  Json events = Json::array();
  const auto number = [](int track) {
    return track == compare::kNoTrack ? Json(nullptr) : Json(track);
  };
  for (const SweepEvent& event : result.events) {
    events.push_back({{"roots", compare::label(event.family)},
                      {"track", number(event.track)},
                      {"what", json_name(event.kind)},
                      {"other_track", number(event.other)},
                      {"row", event.row},
                      {"from", event.from_value},
                      {"to", event.to_value}});
  }
  return events;
}

/// The values of the parameters at a grid point.
Json place_json(const SweepResult& result, std::size_t point) {
  Json place = Json::array();
  for (std::size_t k = 0; k < result.task.axes.size(); ++k) {
    place.push_back(result.task.value(k, point));
  }
  return place;
}

Json agreement_json(const SweepResult& result) {
  Json rows = Json::array();
  for (const auto& row : result.agreement) {
    const bool any = row.compared > 0;
    rows.push_back(
        {{"quantity", row.quantity},
         {"model", row.model},
         {"agrees", row.agrees()},
         {"worst", any ? Json(row.worst) : Json(nullptr)},
         {"tolerance", row.tolerance},
         {"number", any ? Json(row.worst_number) : Json(nullptr)},
         {"at", any ? place_json(result, row.worst_point) : Json::array()},
         {"compared", row.compared},
         {"missing", row.missing},
         {"first_missing_at",
          row.missing > 0 ? place_json(result, row.first_missing_point) : Json::array()}});
  }
  return rows;
}

}  // namespace

std::string sweep_json(const SweepResult& result) {
  return json_document("flexarm.sweep/1", {{"verdict", result.agrees() ? "agree" : "disagree"},
                                           {"arm", arm_json(result.task.arm)},
                                           {"parameters", parameters_json(result)},
                                           {"models", models_json(result)},
                                           {"poles", poles_json(result)},
                                           {"damped_poles", damped_poles_json(result)},
                                           {"zeros", zeros_json(result)},
                                           {"events", events_json(result)},
                                           {"agreement", agreement_json(result)},
                                           {"further_evaluations", result.further_evaluations}});
}

}  // namespace flexarm::report
