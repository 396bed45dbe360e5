// Coordinate-wise slice sampling (Neal 2003) with shrinkage, in the coordinates of SampleChart.
#ifndef HOWL_ESTIMATION_FAMILY_MEMBERS_SLICE_SAMPLER_H_
#define HOWL_ESTIMATION_FAMILY_MEMBERS_SLICE_SAMPLER_H_

#include <vector>

#include "estimation/family/members/sample_chart.h"

namespace howl {

class SliceSampler {
 public:
  // The chart must outlive the sampler. `states`: some members, over whose range the first bracket
  // of each shared parameter's slice is taken.
  SliceSampler(const SampleChart& chart, const std::vector<SampleState>& states);

  // One new value of every coordinate.
  void Sweep(UnitRandom& random, SampleState& state) const;

 private:
  template <typename Set>
  void SlicePlace(UnitRandom& random, SampleState& state, std::size_t i,
                  const SampleChart::Others& others, Range range, const Set& set,
                  double current) const;
  // The bracket has a fixed width and a random place around the current value, which keeps the step
  // reversible.
  void SliceGlobal(UnitRandom& random, SampleState& state, double SampleState::*member) const;
  void SwitchBranch(UnitRandom& random, SampleState& state, std::size_t i,
                    const SampleChart::Others& others) const;

  const SampleChart& chart_;
  const MemberChart& at_ = chart_.chart();
  SampleState widths_;
};

}  // namespace howl

#endif  // HOWL_ESTIMATION_FAMILY_MEMBERS_SLICE_SAMPLER_H_
