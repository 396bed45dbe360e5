#include <algorithm>
#include <cmath>
#include <cstdio>

#include "io/config/schema/nearest_key.h"
#include "io/config/schema/schema_words.h"
#include "io/config/sections/config_sections.h"
#include "model/effects/catalogue.h"

namespace howl {
namespace {

std::string Short(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

// The effect's forms: all with the identifier that the config names.
std::vector<EffectPointer> FormsOf(const ConfigCursor& item) {
  const std::string& id = item.Find("effect")->Node().text;
  std::vector<EffectPointer> forms;
  std::vector<std::string> known;
  for (const EffectPointer& effect : SimulationCatalogue()) {
    if (effect->id() == id) forms.push_back(effect);
    if (known.empty() || known.back() != effect->id()) known.emplace_back(effect->id());
  }
  if (forms.empty()) {
    const auto nearest = NearestKey(id, known);
    item.Find("effect")->Fail("\"" + id + "\" is no effect of the catalogue, expected " +
                              (nearest ? "the nearest one, " + *nearest : Join(known)));
  }
  return forms;
}

EffectPointer ChooseForm(const ConfigCursor& item, const std::vector<EffectPointer>& forms) {
  const std::string key = forms.front()->form().key;
  const auto given = key.empty() ? std::nullopt : item.Find(key);
  if (!given) return forms.front();
  std::vector<std::string> values;
  for (const EffectPointer& form : forms) {
    values.push_back(form->form().value);
    if (given->Node().text == values.back()) return form;
  }
  given->Fail("\"" + given->Node().text + "\" is not known here, expected " +
              DescribeChoice(given->Node().text, values));
}

double ReadParameter(const ConfigCursor& at, const EffectParameter& parameter) {
  const LocatedNode& node = at.Node();
  const bool is_number =
      node.kind == LocatedNode::Kind::kInteger || node.kind == LocatedNode::Kind::kNumber;
  const bool in_range = node.number >= parameter.low && node.number <= parameter.high;
  if (is_number && (in_range || node.number == parameter.null_value)) return node.number;
  at.Fail((is_number ? Short(node.number) + " is out of range" : "is no number") +
          ", expected a number " + (parameter.unit.empty() ? "" : "in " + parameter.unit + " ") +
          "from " + Short(parameter.low) + " to " + Short(parameter.high) + ", or " +
          (std::isinf(parameter.null_value) ? ".inf" : Short(parameter.null_value)) +
          " for no effect");
}

SimulatedEffect ReadEffect(const ConfigCursor& item, const std::string& key) {
  const std::vector<EffectPointer> forms = FormsOf(item);
  SimulatedEffect out{ChooseForm(item, forms), {}, item.Line(), key};
  std::vector<std::string> keys;
  for (const EffectParameter& parameter : out.effect->parameters()) {
    keys.push_back(parameter.name);
    const auto given = item.Find(parameter.name);
    out.values.push_back(given ? ReadParameter(*given, parameter) : parameter.null_value);
  }
  if (!forms.front()->form().key.empty()) keys.push_back(forms.front()->form().key);
  for (const LocatedMember& member : item.Node().members) {
    if (member.key == "effect" || std::ranges::find(keys, member.key) != keys.end()) continue;
    const auto nearest = NearestKey(member.key, keys);
    item.FailAt(member.key, "is no parameter of " + std::string(out.effect->id()) + ", expected " +
                                (nearest ? "the nearest one, " + *nearest : Join(keys)));
  }
  const bool any = std::ranges::any_of(
      out.effect->parameters(), [&](const auto& p) { return item.Find(p.name).has_value(); });
  if (!any) item.FailAt(keys.front(), "is missing, expected " + Join(keys));
  return out;
}

void ReadStart(const ConfigCursor& simulation, SimulationSpec& spec) {
  simulation.Read("start_frequency_hz", spec.start_frequency_hz);
  if (const auto frequency = simulation.Find("start_frequency_hz")) {
    spec.start_line = frequency->Line();
  }
  const auto start = simulation.Find("start");
  if (!start) return;
  spec.start_line = start->Line();
  for (const SimulationStart each : kSimulationStarts) {
    if (start->Node().text == SimulationStartName(each)) spec.start = each;
  }
  if (spec.start_frequency_hz) {
    simulation.FailAt("start_frequency_hz", "is given with start, expected only one of the two");
  }
}

SweepSpec ReadSweep(const ConfigCursor& cursor, const Config& config) {
  SweepSpec sweep;
  sweep.line = cursor.Line();
  for (const SweptParameter each : kSweptParameters) {
    if (cursor.Find("parameter")->Node().text == SweptParameterName(each)) sweep.parameter = each;
  }
  cursor.Read("from", sweep.from);
  cursor.Read("to", sweep.to);
  cursor.Read("one_way_s", sweep.one_way_s);
  cursor.Read("steps", sweep.steps);
  cursor.Read("combustion_noise_relative", sweep.combustion_noise_relative);
  if (sweep.from == sweep.to) cursor.FailAt("to", "is from, expected another value");
  const bool of_second_mode = sweep.parameter == SweptParameter::kM ||
                              sweep.parameter == SweptParameter::kMOverN ||
                              sweep.parameter == SweptParameter::kHarmonicRatio;
  if (of_second_mode && config.model.modes == 1) {
    cursor.FailAt("parameter",
                  "belongs to the second mode, but the model has one; expected modes: 2 under "
                  "model");
  }
  return sweep;
}

}  // namespace

void ReadSimulation(const ConfigCursor& root, Config& config) {
  const auto simulation = root.Find("simulate");
  if (!simulation) return;
  SimulationSpec& spec = config.simulation;
  simulation->Read("duration_s", spec.duration_s);
  simulation->Read("sampling_hz", spec.sampling_hz);
  simulation->Read("settle_s", spec.settle_s);
  if (const auto shape = simulation->Find("flame_shape")) {
    for (const FlameShape each : kStatedFlameShapes) {
      if (shape->Node().text == FlameShapeName(each)) spec.flame_shape = each;
    }
  }
  simulation->Read("saturation", spec.saturation);
  simulation->Read("flame_table", spec.flame_table);
  if (spec.flame_table && (simulation->Find("flame_shape") || simulation->Find("saturation"))) {
    simulation->FailAt("flame_table", "is given with flame_shape or saturation, expected only one");
  }
  spec.flame_is_given = simulation->Find("flame_shape") || simulation->Find("saturation");
  simulation->Read("combustion_noise_relative", spec.combustion_noise_relative);
  simulation->Read("combustion_noise_corner_hz", spec.combustion_noise_corner_hz);
  simulation->Read("sensor_noise_relative", spec.sensor_noise_relative);
  simulation->Read("loop_gain_min", spec.loop_gain_min);
  spec.noise = ReadNoiseSources(*simulation);
  ReadStart(*simulation, spec);
  if (const auto sweep = simulation->Find("sweep")) spec.sweep = ReadSweep(*sweep, config);
  if (const auto effects = simulation->Find("effects")) {
    for (const ConfigCursor& item : effects->Items()) {
      spec.effects.push_back(
          ReadEffect(item, "simulate.effects[" + std::to_string(spec.effects.size()) + "]"));
    }
  }
}

}  // namespace howl
