// SPDX-License-Identifier: Apache-2.0
#include "beaconless/match/wall_rest.hpp"

#include <cmath>

namespace beaconless {

double largest_of(double xx, double xy, double yy) {
  const double half = 0.5 * (xx - yy);
  return 0.5 * (xx + yy) + std::sqrt(half * half + xy * xy);
}

void WallPulls::add(const WallPiece& line, double variance_m2) {
  // The lever Σ W τ stands beside the normal in the sums of x and of y; the larger part of it tells.
  const bool is_along_y = std::abs(line.nx) < std::abs(line.ny);
  const double turn = is_along_y ? line.sums.hessian[4] / line.ny : line.sums.hessian[3] / line.nx;
  const double x = line.nx * line.sums.across();
  const double y = line.ny * line.sums.across();
  squares[0] += variance_m2 * x * x;
  squares[1] += variance_m2 * x * y;
  squares[2] += variance_m2 * y * y;
  squares[3] += variance_m2 * x * turn;
  squares[4] += variance_m2 * y * turn;
  squares[5] += variance_m2 * turn * turn;
}

WallRest rest_without(const PartialSums& all, const PartialSums& left_out, const WallPulls& pulls,
                      const SeparatedFit& fit) {
  // 1. Σ w J Jᵀ of the rest and its inverse, by cofactors.
  const double hxx = all.hessian[0] - left_out.hessian[0];
  const double hxy = all.hessian[1] - left_out.hessian[1];
  const double hyy = all.hessian[2] - left_out.hessian[2];
  const double hxt = all.hessian[3] - left_out.hessian[3];
  const double hyt = all.hessian[4] - left_out.hessian[4];
  const double htt = all.hessian[5] - left_out.hessian[5];
  const double cxx = hyy * htt - hyt * hyt;
  const double cxy = hxt * hyt - hxy * htt;
  const double cxt = hxy * hyt - hxt * hyy;
  const double cyy = hxx * htt - hxt * hxt;
  const double cyt = hxy * hxt - hxx * hyt;
  const double ctt = hxx * hyy - hxy * hxy;
  const double determinant = hxx * cxx + hxy * cxy + hxt * cxt;
  WallRest rest;
  if (!(determinant > 0.0 && cxx > 0.0 && cyy > 0.0 && ctt > 0.0)) return rest;
  rest.is_determined = true;
  const double inverse = 1.0 / determinant;
  const double xx = cxx * inverse;
  const double xy = cxy * inverse;
  const double xt = cxt * inverse;
  const double yy = cyy * inverse;
  const double yt = cyt * inverse;
  const double tt = ctt * inverse;
  // 2. The step.
  const double gx = left_out.gradient[0] - all.gradient[0];
  const double gy = left_out.gradient[1] - all.gradient[1];
  const double gt = left_out.gradient[2] - all.gradient[2];
  const double sx = xx * gx + xy * gy + xt * gt;
  const double sy = xy * gx + yy * gy + yt * gt;
  const double st = xt * gx + yt * gy + tt * gt;
  const double stretch = 1.0 / fit.curvature;
  rest.dx_m = stretch * sx - fit.last_step.x();
  rest.dy_m = stretch * sy - fit.last_step.y();
  rest.dtheta_rad = stretch * st - fit.last_step.z();
  const double noise = fit.variance_factor;
  // 3. What is uncertain of it.
  const auto [pxx, pxy, pyy, pxt, pyt, ptt] = pulls.squares;
  const double ax = pxx * xx + pxy * xy + pxt * xt;
  const double ay = pxy * xx + pyy * xy + pyt * xt;
  const double at = pxt * xx + pyt * xy + ptt * xt;
  const double bx = pxx * xy + pxy * yy + pxt * yt;
  const double by = pxy * xy + pyy * yy + pyt * yt;
  const double bt = pxt * xy + pyt * yy + ptt * yt;
  const double ex = pxx * xt + pxy * yt + pxt * tt;
  const double ey = pxy * xt + pyy * yt + pyt * tt;
  const double et = pxt * xt + pyt * yt + ptt * tt;
  const double vxx = noise * xx + xx * ax + xy * ay + xt * at;
  const double vxy = noise * xy + xx * bx + xy * by + xt * bt;
  const double vyy = noise * yy + xy * bx + yy * by + yt * bt;
  const double vtt = noise * tt + xt * ex + yt * ey + tt * et;
  const double map_m2 = fit.map_sigma_m * fit.map_sigma_m;
  rest.variance_m2 = largest_of(vxx, vxy, vyy) + map_m2;
  rest.variance_rad2 = vtt + map_m2 / (fit.arm_m * fit.arm_m);
  return rest;
}

}  // namespace beaconless
