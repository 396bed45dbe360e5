#include "estimation/family/bounds/bound_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <istream>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "estimation/unit_seed.h"

namespace howl {

namespace {

constexpr std::size_t kMostSearches = 1000000;
constexpr std::string_view kMagic = "howl.enclosure/2";

// As "%a", without the time that a format takes.
void Write(std::ostream& out, double value) {
  char text[40];
  char* at = text;
  if (std::signbit(value)) *at++ = '-';
  if (std::isfinite(value)) {
    *at++ = '0';
    *at++ = 'x';
  }
  at = std::to_chars(at, text + sizeof text - 1, std::abs(value), std::chars_format::hex).ptr;
  *at++ = ' ';
  out.write(text, at - text);
}

bool Read(std::istream& in, double& value) {
  std::string text;
  if (!(in >> text)) return false;
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return end == text.c_str() + text.size();
}

void Write(std::ostream& out, const Interval& x) {
  Write(out, x.lower());
  Write(out, x.upper());
}

bool Read(std::istream& in, Interval& x) {
  double lo = 0.0, hi = 0.0;
  if (!Read(in, lo) || !Read(in, hi) || !(lo <= hi)) return false;
  x.assign(lo, hi);
  return true;
}

void Write(std::ostream& out, const Cell& cell) {
  Write(out, cell.bound);
  Write(out, cell.window_hz);
  for (const ExperimentBox& box : cell.boxes) {
    for (const Interval& x : box) Write(out, x);
  }
  out << '\n';
}

bool Read(std::istream& in, std::size_t experiments, Cell& cell) {
  cell.boxes.resize(experiments);
  if (!Read(in, cell.bound) || !Read(in, cell.window_hz)) return false;
  for (ExperimentBox& box : cell.boxes) {
    for (Interval& x : box) {
      if (!Read(in, x)) return false;
    }
  }
  return true;
}

// One order for writing and reading.
template <typename Model, typename Visitor>
bool VisitModel(Model& model, const Visitor& visit) {
  return visit(model.omega_hz) && visit(model.xi) && visit(model.N) && visit(model.M) &&
         visit(model.tau_s) && visit(model.harmonic_ratio);
}

template <typename Search, typename Visitor>
bool VisitEnds(Search& search, const Visitor& visit) {
  return visit(search.inner) && visit(search.finest_reach) && visit(search.outer) &&
         visit(search.focus.xi_end) && visit(search.focus.phase_end) &&
         visit(search.focus.gain_end) && visit(search.focus.loop_phase_end) &&
         visit(search.focus.omega_end);
}

void Write(std::ostream& out, const BoundSearch& search) {
  const auto write = [&](double value) {
    Write(out, value);
    return true;
  };
  out << static_cast<int>(search.state) << ' ' << search.random.State() << ' ' << search.cells
      << ' ' << search.counts.inside << ' ' << search.counts.outside << ' '
      << search.counts.undecided << ' ' << search.counts.pending << ' ' << search.focus.pattern
      << ' ';
  VisitEnds(search, write);
  out << search.witness.size() << ' ';
  for (const LoopModel& model : search.witness) VisitModel(model, write);
  out << search.heap.size() << '\n';
  for (const Cell& cell : search.heap) Write(out, cell);
}

bool Read(std::istream& in, std::size_t experiments, BoundSearch& search) {
  const auto read = [&](double& value) { return Read(in, value); };
  int state = 0;
  std::uint64_t random = 0;
  std::size_t witness = 0, heap = 0;
  in >> state >> random >> search.cells >> search.counts.inside >> search.counts.outside >>
      search.counts.undecided >> search.counts.pending >> search.focus.pattern;
  if (!in || state < 0 || state > static_cast<int>(SearchState::kBudget)) return false;
  search.state = static_cast<SearchState>(state);
  search.random.SetState(random);
  if (!VisitEnds(search, read)) return false;
  if (!(in >> witness) || (witness != 0 && witness != experiments)) return false;
  search.witness.resize(witness);
  for (LoopModel& model : search.witness) {
    if (!VisitModel(model, read)) return false;
  }
  if (!(in >> heap)) return false;
  search.heap.clear();
  for (std::size_t k = 0; k < heap; ++k) {
    Cell cell;
    if (!Read(in, experiments, cell)) return false;
    search.heap.push_back(std::move(cell));
  }
  return true;
}

// A limit on lengths, so that a damaged length does not claim memory.
std::size_t BytesLeft(std::istream& in) {
  const std::istream::pos_type here = in.tellg();
  in.seekg(0, std::ios::end);
  const std::istream::pos_type end = in.tellg();
  in.seekg(here);
  return end > here ? static_cast<std::size_t>(end - here) : 0;
}

struct Head {
  std::size_t searches = 0;
  std::size_t experiments = 0;
};

bool ReadHead(std::istream& in, Head& head) {
  std::string magic;
  return in >> magic >> head.searches >> head.experiments && magic == kMagic;
}

// The text of the next search; no value where it is not what was written. Where a length is
// damaged, so are all that follow: where the next begins is not known.
std::optional<std::string> NextSearch(std::istream& in) {
  std::size_t size = 0;
  std::uint64_t hash = 0;
  const bool framed = in >> size >> hash && in.get() == '\n' && size <= BytesLeft(in);
  std::string bytes(framed ? size : 0, '\0');
  if (!framed || !in.read(bytes.data(), static_cast<std::streamsize>(size))) {
    in.setstate(std::ios::failbit);
    return std::nullopt;
  }
  return UnitSeed(0, bytes) == hash ? std::optional(std::move(bytes)) : std::nullopt;
}

}  // namespace

std::string BoundSearchHead(std::size_t experiments, std::size_t searches) {
  return std::string(kMagic) + " " + std::to_string(searches) + " " + std::to_string(experiments) +
         "\n";
}

std::string BoundSearchText(const BoundSearch& search) {
  std::ostringstream text;
  Write(text, search);
  const std::string bytes = std::move(text).str();
  return std::to_string(bytes.size()) + " " + std::to_string(UnitSeed(0, bytes)) + "\n" + bytes;
}

std::optional<std::size_t> ReadBoundSearches(std::istream& in, std::size_t experiments,
                                             std::vector<BoundSearch>& searches) {
  Head head;
  if (!ReadHead(in, head) || head.searches != searches.size() || head.experiments != experiments) {
    return std::nullopt;
  }
  std::size_t damaged = 0;
  for (std::size_t k = 0; k < searches.size(); ++k) {
    BoundSearch search = searches[k];
    const std::optional<std::string> bytes = NextSearch(in);
    std::istringstream text(bytes.value_or(""));
    if (bytes && Read(text, experiments, search)) {
      searches[k] = std::move(search);
    } else {
      ++damaged;
    }
  }
  return damaged;
}

std::size_t CountDamagedSearches(std::istream& in) {
  Head head;
  std::size_t damaged = 0;
  if (!ReadHead(in, head)) return 0;
  for (std::size_t k = 0; k < head.searches && k < kMostSearches; ++k) {
    damaged += NextSearch(in) ? 0 : 1;
  }
  return damaged;
}

}  // namespace howl
