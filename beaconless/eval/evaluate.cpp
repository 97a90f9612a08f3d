// SPDX-License-Identifier: Apache-2.0
#include "beaconless/eval/evaluate.hpp"

#include "beaconless/eval/alignment.hpp"

namespace beaconless::eval {

Evaluation evaluate(const Trajectory& estimate, const Trajectory& reference, double max_gap_s) {
  Association association = associate(estimate, reference, max_gap_s);
  Evaluation evaluation;
  evaluation.unmatched_count = association.unmatched_count;
  evaluation.errors = errors_of(association.pairs);
  evaluation.raw = table_of(evaluation.errors);

  evaluation.reference_from_estimate = align(association.pairs);
  for (PosePair& pair : association.pairs) pair.estimate = evaluation.reference_from_estimate * pair.estimate;
  evaluation.aligned_errors = errors_of(association.pairs);
  evaluation.aligned = table_of(evaluation.aligned_errors);
  return evaluation;
}

}  // namespace beaconless::eval
