#include "diagnosis/fit/fit_memory.h"

#include <glog/logging.h>

#include <cstdint>
#include <cstring>

namespace howl {
namespace {

constexpr std::uint64_t kMostColumns = 1'000'000;  // of a matrix without rows

class Writer {
 public:
  void Add(double x) { Append(&x, 1); }
  void Add(const std::vector<double>& x) { AddSized(x.data(), x.size(), 1); }
  template <typename Scalar, int Rows, int Cols>
  void Add(const Eigen::Matrix<Scalar, Rows, Cols>& x) {
    AddSized(x.data(), static_cast<std::size_t>(x.size()), static_cast<std::size_t>(x.cols()));
  }
  std::string Take() { return std::move(bytes_); }

 private:
  template <typename Scalar>
  void AddSized(const Scalar* data, std::size_t size, std::size_t columns) {
    const std::uint64_t sizes[] = {size, columns};
    Append(sizes, 2);
    Append(data, size);
  }
  template <typename T>
  void Append(const T* data, std::size_t count) {
    if (count == 0) return;
    bytes_.append(reinterpret_cast<const char*>(data), count * sizeof(T));
  }
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}

  bool Get(double* x) { return Copy(x, 1); }
  bool Get(std::vector<double>* x) {
    std::uint64_t size = 0;
    std::uint64_t columns = 0;
    if (!Sizes(sizeof(double), &size, &columns) || columns != 1) return false;
    x->resize(size);
    return Copy(x->data(), size);
  }
  template <typename Scalar, int Rows, int Cols>
  bool Get(Eigen::Matrix<Scalar, Rows, Cols>* x) {
    std::uint64_t size = 0;
    std::uint64_t columns = 0;
    if (!Sizes(sizeof(Scalar), &size, &columns)) return false;
    if (columns == 0 ? size != 0 : size % columns != 0) return false;
    const auto rows = static_cast<Eigen::Index>(columns == 0 ? 0 : size / columns);
    const auto cols = static_cast<Eigen::Index>(columns);
    if (Rows != Eigen::Dynamic && rows != Rows) return false;
    if (Cols != Eigen::Dynamic && cols != Cols) return false;
    x->resize(rows, cols);
    return Copy(x->data(), size);
  }
  bool AtEnd() const { return position_ == bytes_.size(); }

 private:
  // No more numbers than there are bytes for: a damaged size does not claim memory.
  bool Sizes(std::size_t bytes_each, std::uint64_t* size, std::uint64_t* columns) {
    return Copy(size, 1) && Copy(columns, 1) && *size <= (bytes_.size() - position_) / bytes_each &&
           *columns <= kMostColumns;
  }
  template <typename T>
  bool Copy(T* to, std::size_t count) {
    const std::size_t size = count * sizeof(T);
    if (size > bytes_.size() - position_) return false;
    if (size > 0) std::memcpy(to, bytes_.data() + position_, size);
    position_ += size;
    return true;
  }
  const std::string& bytes_;
  std::size_t position_ = 0;
};

// One list of the fields serves both reading and writing.
template <typename Fit, typename Visit>
bool VisitNumbers(Fit& fit, const Visit& visit) {
  bool good = visit(fit.values) && visit(fit.tau_s) && visit(fit.delay_scatter) &&
              visit(fit.acoustic_cost) && visit(fit.flame_cost) && visit(fit.delay_cost) &&
              visit(fit.freedom_cost) && visit(fit.standard_errors);
  for (auto& at : fit.experiments) {
    good = good && visit(at.acoustics) && visit(at.flame) && visit(at.flame_range) &&
           visit(at.log_delay) && visit(at.acoustic_residual) && visit(at.flame_residual) &&
           visit(at.acoustic_noise) && visit(at.flame_noise) && visit(at.gradient) &&
           visit(at.curvature);
  }
  return good;
}

}  // namespace

void UniqueKeys::Take(const std::string& key) {
  CHECK(taken_.insert(key).second) << key << " is " << verb_ << " twice: two units share a key";
}

std::string ToBytes(const EffectFit& fit) {
  Writer writer;
  VisitNumbers(fit, [&](const auto& x) {
    writer.Add(x);
    return true;
  });
  return writer.Take();
}

std::optional<EffectFit> FromBytes(const std::string& bytes, const std::vector<CutRecord>& records,
                                   const EffectPointer& effect) {
  EffectFit fit;
  fit.effect = effect;
  fit.experiments.resize(records.size());
  Reader reader(bytes);
  if (!VisitNumbers(fit, [&](auto& x) { return reader.Get(&x); }) || !reader.AtEnd()) {
    return std::nullopt;
  }
  if (fit.values.size() != effect->parameters().size()) return std::nullopt;
  for (std::size_t e = 0; e < records.size(); ++e) {
    if (fit.experiments[e].acoustic_residual.size() != records[e].acoustic_count ||
        fit.experiments[e].flame_residual.size() != records[e].flame_count) {
      return std::nullopt;
    }
  }
  return fit;
}

namespace {

// The fit by FitEffect, unless the memory has it.
EffectFit FitOrRecall(FitUnits* memory, const std::string& key,
                      const std::vector<CutRecord>& records, const EffectPointer& effect,
                      const EffectFit& base) {
  if (!memory) return FitEffect(records, effect, base);
  if (const auto bytes = memory->Recall(key)) {
    if (auto fit = FromBytes(*bytes, records, effect)) return std::move(*fit);
  }
  EffectFit fit = FitEffect(records, effect, base);
  memory->Keep(key, ToBytes(fit));
  return fit;
}

}  // namespace

EffectFit FitBestForm(FitUnits* memory, const std::string& unit,
                      const std::vector<CutRecord>& records,
                      const std::vector<EffectPointer>& forms, const EffectFit& base) {
  std::optional<EffectFit> best;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    EffectFit fit = FitOrRecall(memory, unit + "#" + std::to_string(i), records, forms[i], base);
    if (!best || fit.cost() < best->cost()) best = std::move(fit);
  }
  return std::move(*best);
}

}  // namespace howl
