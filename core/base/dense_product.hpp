// SPDX-License-Identifier: BSD-3-Clause
/// Products of large dense matrices at the speed of the machine at hand, as in DenseFactor.
#pragma once

#include <Eigen/Core>

namespace cdca {

using DenseBlock = Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
using DenseSum = Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

/// Which of the two matrices of a product is transposed.
enum class Transposed { neither, first, second };

/// sum += factor a b. It must be neither a nor b.
void add_product(double factor, const DenseBlock& a, const DenseBlock& b, Transposed which,
                 DenseSum sum);
/// The same for the lower triangle of a square sum; what lies above it is of no use afterwards.
void add_lower_product(double factor, const DenseBlock& a, const DenseBlock& b, Transposed which,
                       DenseSum sum);

}  // namespace cdca
