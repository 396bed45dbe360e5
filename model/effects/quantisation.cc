// p is recorded with few levels.
#include <cmath>
#include <limits>

#include "model/effects/catalogue.h"

namespace howl {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Levels final : public NamedEffect {
 public:
  Levels()
      : NamedEffect("quantisation", LoopBlock::kPressureInstrument,
                    {{"levels", "", kInfinity, 2.0, 1e9, {}}}) {}
  EffectKind kind() const override { return EffectKind::kQuantisation; }
  bool ChangesAcousticCut() const override { return true; }
  bool ChangesFlameCut() const override { return true; }
};

}  // namespace

std::vector<EffectPointer> Quantisation() { return {std::make_shared<Levels>()}; }

}  // namespace howl
