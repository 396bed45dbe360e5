#include "io/report/page/browser_data.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "estimation/analysis/spectra/half_width.h"
#include "io/report/figures/curves.h"

namespace howl {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kRecordWindow_s = 0.1;
constexpr double kRecordPeriods = 20.0;
constexpr std::size_t kTransferPoints = 160;

static_assert(std::endian::native == std::endian::little);

void Append(std::string& bytes, double value) {
  const auto single = static_cast<float>(value);
  bytes.append(reinterpret_cast<const char*>(&single), sizeof single);
}

Json Rounded(double value) {
  if (!std::isfinite(value)) return nullptr;
  char text[32];
  std::snprintf(text, sizeof text, "%.7g", value);
  return std::strtod(text, nullptr);
}

Json EstimateJson(const Estimate& estimate) {
  return {Rounded(estimate.value), Rounded(HalfWidth95(estimate))};
}

// A piece from the middle of the record.
Json RecordJson(const ReportInput& input, const std::string& name, double frequency_hz) {
  const NamedRecord* named = input.RecordOf(name);
  const bool simulated = named == nullptr;
  if (simulated) named = input.SimulatedOf(name);
  if (named == nullptr) return nullptr;
  const Record& record = named->record;
  const double window_s = std::max(kRecordWindow_s, kRecordPeriods / frequency_hz);
  // The frequency is a result's: of a damaged one the window may be infinite.
  const auto samples = static_cast<double>(record.pressure.size());
  const auto count = static_cast<std::size_t>(std::min(samples, window_s * record.sampling_hz));
  const std::size_t first = (record.pressure.size() - count) / 2;
  std::string p;
  std::string q;
  for (std::size_t i = first; i < first + count; ++i) {
    Append(p, record.pressure[i]);
    if (!record.heat_release.empty()) Append(q, record.heat_release[i]);
  }
  return {{"simulated", simulated},
          {"remark", simulated ? SimulationRemark(input, name) : ""},
          {"sampling_hz", record.sampling_hz},
          {"p", Base64(p)},
          {"q", Base64(q)}};
}

Json TransferJson(const ReportInput& input, const std::string& name) {
  if (!input.transfer) return nullptr;
  const CsvTable& table = *input.transfer;
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (table.Text(row, "name") == name) rows.push_back(row);
  }
  if (rows.empty()) return nullptr;
  Json frequency = Json::array();
  Json gain = Json::array();
  Json phase = Json::array();
  const std::size_t step = std::max<std::size_t>(1, rows.size() / kTransferPoints);
  for (std::size_t k = 0; k < rows.size(); k += step) {
    const std::complex<double> h(table.Number(rows[k], "re"), table.Number(rows[k], "im"));
    frequency.push_back(Rounded(table.Number(rows[k], "frequency_hz")));
    gain.push_back(Rounded(std::abs(h)));
    phase.push_back(Rounded(PhaseDeg(h)));
  }
  return {{"frequency_hz", frequency}, {"gain", gain}, {"phase_deg", phase}};
}

Json ExperimentJson(const ReportInput& input, const std::string& name, double phi) {
  Json json = {{"name", name}, {"phi", Rounded(phi)}};
  const MeasuredPoint* point = input.Measured(name);
  if (point == nullptr || !point->has_cycle()) return json;
  json["frequency_hz"] = EstimateJson(point->frequency_hz);
  json["phase_deg"] = EstimateJson(point->phase_deg);
  json["gain"] = EstimateJson(point->gain);
  json["tau_s"] = EstimateJson(point->tau_s);
  json["loop_gain"] = EstimateJson(point->loop_gain);
  json["flame_slope"] = Rounded(point->flame_slope.value);
  json["reliable"] = point->reliable;
  Json lines = Json::array();
  for (const MeasuredLine& line : input.lines) {
    if (line.experiment == name && line.harmonic == 0 && lines.size() < 6) {
      lines.push_back(Rounded(line.frequency_hz.value));
    }
  }
  json["lines_hz"] = lines;
  json["transfer"] = TransferJson(input, name);
  json["record"] = RecordJson(input, name, point->frequency_hz.value);
  if (const ExperimentModel* fit = input.Fitted(name)) {
    json["fit"] = {Rounded(fit->model.omega_hz), Rounded(fit->model.xi), Rounded(fit->model.N),
                   Rounded(fit->model.M), Rounded(fit->model.tau_s)};
  }
  return json;
}

}  // namespace

std::string Base64(const std::string& bytes) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      out += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return out;
}

Json BrowserData(const ReportInput& input) {
  if (!input.members) return nullptr;
  const FamilyMembers& members = *input.members;
  Json experiments = Json::array();
  for (std::size_t i = 0; i < members.experiments.size(); ++i) {
    experiments.push_back(ExperimentJson(input, members.experiments[i], members.phi[i]));
  }
  std::string bytes;
  bytes.reserve(members.models.size() * members.experiments.size() * 20);
  for (const std::vector<LoopModel>& models : members.models) {
    for (const LoopModel& model : models) {
      for (const double value : {model.omega_hz, model.xi, model.N, model.M, model.tau_s}) {
        Append(bytes, value);
      }
    }
  }
  Json tradeoff = Json::array();
  for (std::size_t row = 0; input.tradeoff && row < input.tradeoff->rows.size(); ++row) {
    tradeoff.push_back({Rounded(input.tradeoff->Number(row, "omega_spread")),
                        Rounded(input.tradeoff->Number(row, "xi_max"))});
  }
  const SimulationSpec spec = input.config ? input.config->simulation : SimulationSpec{};
  return {
      {"operating_label", input.OperatingLabel()},
      {"harmonic_ratio", input.config ? input.config->model.harmonic_ratio : kPaperHarmonicRatio},
      {"saturation", spec.saturation},
      {"loop_gain_min", spec.loop_gain_min},
      {"flame_shape", std::string(FlameShapeName(spec.flame_shape))},
      {"experiments", experiments},
      {"members", members.models.size()},
      {"parameters", Base64(bytes)},
      {"tradeoff", tradeoff}};
}

}  // namespace howl
