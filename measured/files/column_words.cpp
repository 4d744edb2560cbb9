#include "measured/files/column_words.hpp"

#include "arm/ascii.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace flexarm::measured {

namespace {

using std::string_view;
using Word = string_view;

constexpr Word kTimeWords[] = {"t", "time", "times", "timestamp", "elapsed", "elapsedtime",
                               "datetime", "dateandtime", "xvalue",
                               // German
                               "zeit", "uhrzeit", "datumuhrzeit", "datumzeit", "messzeit",
                               "zeitstempel", "versuchszeit", "laufzeit",
                               // French
                               "temps", "tempsecoule", "heure", "horodatage"};
constexpr Word kTorqueWords[] = {
    "torque", "tau", "hubtorque", "motortorque", "appliedtorque", "inputtorque", "commandedtorque",
    "torquecommand", "torquecmd",
    // German
    "moment", "drehmoment", "motormoment", "antriebsmoment", "nabenmoment", "stellmoment",
    "sollmoment", "momentsoll", "solldrehmoment", "drehmomentsoll", "istmoment", "momentist",
    "istdrehmoment", "drehmomentist", "motordrehmoment", "drehmomentmotor",
    // French
    "couple", "couplemoteur", "couplecommande", "consignedecouple"};
constexpr Word kHubAngleWords[] = {
    "hubangle", "theta", "angle", "motorangle", "shaftangle", "jointangle", "hub", "hubposition",
    "motorposition", "encoder", "motorencoder", "shaftencoder", "linkangle", "armangle",
    "loadangle",
    // German
    "winkel", "drehwinkel", "nabenwinkel", "motorwinkel", "wellenwinkel", "gelenkwinkel",
    "armwinkel", "winkelnabe", "winkelmotor", "winkelwelle", "winkelist", "istwinkel",
    // French
    "anglemoteur", "anglemoyeu", "anglearbre", "angledumoteur", "positionangulaire"};
constexpr Word kHubVelocityWords[] = {
    "hubvelocity", "hubspeed", "omega", "thetadot", "dtheta", "angularvelocity",
    "hubangularvelocity", "motorangularvelocity", "angularspeed", "angularrate", "hubrate",
    "velocity", "speed", "motorspeed", "motorvelocity", "tacho", "tachometer",
    // German
    "winkelgeschwindigkeit", "winkelgeschw", "drehgeschwindigkeit", "geschwindigkeit", "drehzahl",
    "motordrehzahl", "drehzahlmotor", "nabengeschwindigkeit", "motorgeschwindigkeit",
    // French
    "vitesse", "vitesseangulaire", "vitesserotation", "vitessederotation", "vitessemoteur"};
constexpr Word kTipAccelerationWords[] = {
    "tipacceleration", "tipaccel", "tipacc", "acceleration", "accel", "acc", "accelerometer",
    "endpointacceleration",
    // German
    "beschleunigung", "spitzenbeschleunigung", "endpunktbeschleunigung", "beschleunigungspitze",
    "beschleunigungsaufnehmer", "beschleunigungssensor",
    // French
    "accelerometre", "accelerationbout", "accelerationextremite"};
constexpr Word kTipDisplacementWords[] = {"tipdisplacement", "tipposition", "endpointposition",
                                          "displacement",
                                          // German
                                          "spitzenposition", "endpunktposition"};
constexpr Word kTipDeflectionWords[] = {"tipdeflection", "tipdefl", "deflection", "defl",
                                        // German
                                        "durchbiegung", "spitzendurchbiegung",
                                        // French
                                        "fleche"};

constexpr Word kPositionWords[] = {"position", "jointposition", "actualposition", "positionactual",
                                   "pos"};

constexpr std::array<QuantityWords, 8> kQuantities = {{
    {"time", kTimeWords},
    {"torque", kTorqueWords},
    {"hub_angle", kHubAngleWords},
    {"hub_velocity", kHubVelocityWords},
    {"tip_acceleration", kTipAccelerationWords},
    {"tip_displacement", kTipDisplacementWords},
    {"tip_deflection", kTipDeflectionWords},
    {"hub_angle", kPositionWords, true},
}};

constexpr Word kPathWords[] = {"auslenkung",        "verschiebung", "weg",
                               "wegaufnehmer",      "wegsensor",    "ausschlag",
                               "spitzenauslenkung", "deplacement"};
constexpr Word kStrainWords[] = {"strain", "straingauge", "straingage", "gauge", "gage",
                                 // German
                                 "dehnung", "dms", "dehnungsmessstreifen", "stauchung",
                                 // French
                                 "deformation", "jauge", "jaugededeformation"};
constexpr Word kCurrentWords[] = {"current", "motorcurrent", "armaturecurrent",
                                  // German
                                  "strom", "motorstrom", "ankerstrom", "stromist", "stromsoll",
                                  // French
                                  "courant", "courantmoteur", "intensite"};
constexpr Word kVoltageWords[] = {"voltage", "motorvoltage", "outputvoltage", "armaturevoltage",
                                  // German
                                  "spannung", "motorspannung", "ankerspannung", "stellspannung",
                                  "ausgangsspannung",
                                  // French
                                  "tension", "tensionmoteur"};

/// Words of torques that are not the motor's, or not as it acts; whole ones, and their beginnings.
constexpr Word kOtherTorques[] = {"max", "min", "ref", "std", "abs", "err", "lim", "neg", "rate",
                                  // a logarithm, indices of friction and load, a side of the gear
                                  "log", "ln", "f", "fr", "l", "ext", "before", "vor", "avant"};
constexpr Word kOtherTorqueStems[] = {"maxim", "minim", "refer", "stdev", "absol", "error", "limit",
                                      "negat", "deriv", "inverted", "inverse", "offset", "bias",
                                      "noise", "ripple", "bend", "root", "clamp", "fric", "disturb",
                                      "upstream", "load", "gravi", "energ",
                                      // German
                                      "bieg", "wurzel", "einspann", "grenz", "fehler", "rausch",
                                      "reib", "stoer", "last", "invertiert",
                                      // French
                                      "flexion", "encastr", "bruit", "frott", "perturb", "resist"};

constexpr string_view kLengths[] = {"m", "mm", "cm", "um", "inch"};
constexpr string_view kStrains[] = {"1", "ustrain", "mstrain", "%", "V", "mV", "mV/V"};
constexpr string_view kCurrents[] = {"A", "mA"};
constexpr string_view kVoltages[] = {"V", "mV"};

constexpr string_view kPath =
    "--column 'tip_deflection={0}' (relative to the rigid arm) or "
    "--column 'tip_displacement={0}' (absolute)";
constexpr string_view kPosition =
    "--column 'hub_angle={0}:rad', --column 'tip_deflection={0}:m' (relative to the rigid arm) or "
    "--column 'tip_displacement={0}:m' (absolute)";
constexpr string_view kGauge = "--column 'strain@X={0}', X in m from the hub";
constexpr string_view kCurrent = "--torque 'K*[{0}]', K in N m/A";
constexpr string_view kVoltage = "--torque 'K*[{0}]', K in N m/V";

constexpr std::array<OpenWords, 5> kOpen = {{
    {kPositionWords, kLengths, "an angle of the hub or a displacement", kPosition},
    {kPathWords, kLengths, "a displacement", kPath},
    {kStrainWords, kStrains, "a strain at a place that the file does not tell", kGauge},
    {kCurrentWords, kCurrents, "a motor current", kCurrent, true},
    {kVoltageWords, kVoltages, "a voltage", kVoltage, true},
}};

/// Letters of German and French beyond ASCII, in UTF-8, as plain ones.
constexpr std::array<std::pair<string_view, string_view>, 38> kAccents = {{
    {"\xc3\xa4", "ae"},    {"\xc3\x84", "ae"},    {"\xc3\xb6", "oe"}, {"\xc3\x96", "oe"},
    {"\xc3\xbc", "ue"},    {"\xc3\x9c", "ue"},    {"\xc3\x9f", "ss"}, {"\xc3\xa0", "a"},
    {"\xc3\x80", "a"},     {"\xc3\xa2", "a"},     {"\xc3\x82", "a"},  {"\xc3\xa7", "c"},
    {"\xc3\x87", "c"},     {"\xc3\xa8", "e"},     {"\xc3\x88", "e"},  {"\xc3\xa9", "e"},
    {"\xc3\x89", "e"},     {"\xc3\xaa", "e"},     {"\xc3\x8a", "e"},  {"\xc3\xab", "e"},
    {"\xc3\x8b", "e"},     {"\xc3\xae", "i"},     {"\xc3\x8e", "i"},  {"\xc3\xaf", "i"},
    {"\xc3\x8f", "i"},     {"\xc3\xb4", "o"},     {"\xc3\x94", "o"},  {"\xc3\xb9", "u"},
    {"\xc3\x99", "u"},     {"\xc3\xbb", "u"},     {"\xc3\x9b", "u"},  {"\xc5\x93", "oe"},
    {"\xc5\x92", "oe"},    {"\xc3\xa6", "ae"},    {"\xc3\x86", "ae"}, {"\xcf\x84", "tau"},
    {"\xce\xb8", "theta"}, {"\xcf\x89", "omega"},
}};

}  // namespace

std::span<const QuantityWords> quantity_words() {
  return kQuantities;
}

std::span<const OpenWords> open_words() {
  return kOpen;
}

std::string other_torque_word(string_view name) {
  const auto is_lower = [](char c) { return c >= 'a' && c <= 'z'; };
  const auto is_upper = [](char c) { return c >= 'A' && c <= 'Z'; };
  for (std::size_t begin = 0; begin < name.size();) {
    std::size_t end = begin;
    while (end < name.size() &&
           (is_lower(name[end]) || is_upper(name[end]) || arm::is_beyond_ascii(name[end]))) {
      ++end;
      if (end < name.size() && is_lower(name[end - 1]) && is_upper(name[end])) break;
    }
    const string_view word = name.substr(begin, end - begin);
    const std::string letters = plain_letters(word);
    const bool is_structure = letters == "log" && name.substr(end).starts_with('.');
    const bool is_other = (!is_structure && std::ranges::count(kOtherTorques, letters) > 0) ||
                          std::ranges::any_of(kOtherTorqueStems,
                                              [&](Word stem) { return letters.starts_with(stem); });
    if (is_other) return std::string(word);
    begin = std::max(end, begin + 1);
  }
  return "";
}

bool is_holder(string_view field) {
  constexpr std::array<string_view, 7> kHolders = {"values",  "value",  "data",   "column",
                                                   "signals", "signal", "samples"};
  const std::string letters = plain_letters(field.substr(0, field.find_first_of("({")));
  return std::ranges::count(kHolders, string_view(letters)) > 0;
}

std::string plain_letters(string_view name) {
  std::string out;
  while (!name.empty()) {
    const char c = name.front();
    const auto accent = std::ranges::find_if(
        kAccents, [&](const auto& entry) { return name.starts_with(entry.first); });
    if (accent != kAccents.end()) {
      out += accent->second;
      name.remove_prefix(accent->first.size());
      continue;
    }
    if (c >= 'A' && c <= 'Z') out += static_cast<char>(c - 'A' + 'a');
    if (c >= 'a' && c <= 'z') out += c;
    name.remove_prefix(1);
  }
  return out;
}

}  // namespace flexarm::measured
