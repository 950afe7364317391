//! The linearised flow of the rotation: the evolution of small differences of two motions over one step.
//!
//! A step is split into rotations at constant `L` and kicks of `L` at constant `n`, with the weights of Simpson's rule, so
//! that the linear map is accurate to some per cent over a radian and preserves the structure of the motion over any time.

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::RigidSpheroid;
use crate::propagation::taylor::shared_rounding::SharedRounding;

/// Longest part of a step, in radians of the rotation. The maps of successive steps do not fit together exactly, so that estimates grow
/// exponentially after a long time. For tp-I at a tolerance of 1e-12 the estimate after 2e5 t_c is 2e-9 with these parts, and lost with parts of
/// half a radian.
const LONGEST_PART: f64 = 0.25;

/// A linear map of differences `(theta, w, rho)`: the small rotation `theta` of the vectors that rotate with `L / I^xx`
/// (`n`, and the vector from which `e_x` follows at a constant rate), the difference `w` of `L / I^xx`, and the relative
/// difference `rho` of the length of `n`.
pub(super) enum LinearMap {
    /// `w += from_rotation theta + from_length rho`; `made` is added to the known error.
    Kick { from_rotation: Matrix3<f64>, from_length: Vector3<f64>, made: Vector3<f64> },
    /// `theta = from_rotation theta + from_momentum w`, with `made` as above.
    Rotation { from_rotation: Matrix3<f64>, from_momentum: Matrix3<f64>, made: Vector3<f64> },
}

/// The linearised equations of motion of one body, in the unit of time of the caller.
#[derive(Debug, Clone, Copy)]
pub(super) struct LinearisedFlow {
    /// `2 C s^IJ / I^xx`, in units of the squared rate.
    pull: Matrix3<f64>,
    /// The difference between the equations that the computed motion follows and the exact ones.
    shared: SharedRounding,
    /// `L / I^xx` for one unit of `L`, in the unit of time.
    rate: f64,
}

impl LinearisedFlow {
    /// The equations for a body in the unit of time `unit`; `tensor` is `s^IJ` without its trace.
    pub(super) fn new(spheroid: &RigidSpheroid<f64>, tensor: &Matrix3<f64>, unit: f64, shared: SharedRounding) -> Self {
        let RigidSpheroid { inertia_xx, constant_c, .. } = *spheroid;
        let pull = tensor * (2.0 * unit * (constant_c / inertia_xx) * unit);
        Self { pull, shared, rate: unit / inertia_xx }
    }

    /// Largest rate at which the torque changes `L / I^xx`.
    pub(super) fn strength(&self) -> f64 {
        self.pull.norm()
    }

    /// Calls `apply` with the maps over the time `h` from `start` to `end`, each `(n, L / I^xx)`, in order.
    pub(super) fn over(
        &self,
        start: (Vector3<f64>, Vector3<f64>),
        end_axis: &Vector3<f64>,
        h: f64,
        mut apply: impl FnMut(&LinearMap),
    ) {
        let (mut n, mut w) = start;
        let rate = w.norm() + self.pull.norm().sqrt();
        let parts = (rate * h.abs() / LONGEST_PART).ceil().clamp(1.0, 128.0) as usize;
        let h = h / parts as f64;
        for part in 0..parts {
            for (share, correction, is_last) in
                [(1.0 / 6.0, 0.0, false), (2.0 / 3.0, h * h / 48.0, false), (1.0 / 6.0, 0.0, true)]
            {
                if is_last && part + 1 == parts {
                    n = *end_axis;
                }
                let (map, change) = self.kick(&n, h * share, correction);
                apply(&map);
                w += change;
                if !is_last {
                    let (map, turned) = self.rotation(&n, &w, h / 2.0);
                    apply(&map);
                    n = turned;
                }
            }
        }
    }

    /// As [`over`](Self::over), for a small part of a step between two given states.
    pub(super) fn over_little(
        &self,
        ends: [(Vector3<f64>, Vector3<f64>); 2],
        h: f64,
        mut apply: impl FnMut(&LinearMap),
    ) {
        let [(n, w), (end_axis, end_w)] = ends;
        apply(&self.kick(&n, h / 2.0, 0.0).0);
        apply(&self.rotation(&n, &((w + end_w) / 2.0), h).0);
        apply(&self.kick(&end_axis, h / 2.0, 0.0).0);
    }

    /// The kick of the potential `U = n.(S n) / 2 - correction |S n x n|^2` over the time `h`.
    fn kick(&self, n: &Vector3<f64>, h: f64, correction: f64) -> (LinearMap, Vector3<f64>) {
        let pulled = self.pull * n;
        let (mut gradient, mut curvature) = (pulled, self.pull);
        if correction > 0.0 {
            let twice = 2.0 * n.dot(&pulled);
            let second = self.pull * (2.0 * correction);
            gradient += pulled * (twice * 2.0 * correction) - second * pulled;
            curvature += self.pull * (twice * 2.0 * correction) - second * self.pull
                + pulled * pulled.transpose() * (8.0 * correction);
        }
        let across = n.cross_matrix();
        let map = LinearMap::Kick {
            from_rotation: (across * curvature - gradient.cross_matrix()) * across * h,
            from_length: pulled.cross(n) * (2.0 * h),
            made: self.shared.torque(n) * (self.rate * h),
        };
        (map, gradient.cross(n) * h)
    }

    fn rotation(&self, n: &Vector3<f64>, w: &Vector3<f64>, h: f64) -> (LinearMap, Vector3<f64>) {
        let angle = w * h;
        let square = angle.norm_squared();
        // sin x / x, (1 - cos x) / x^2, (x - sin x) / x^3
        let [a, b, c] = if square < 1e-6 {
            [1.0 - square / 6.0, 0.5 - square / 24.0, 1.0 / 6.0 - square / 120.0]
        } else {
            let (sin, cos) = square.sqrt().sin_cos();
            let a = sin / square.sqrt();
            [a, (1.0 - cos) / square, (1.0 - a) / square]
        };
        let first = angle.cross_matrix();
        let second = angle * angle.transpose() - Matrix3::from_diagonal_element(square);
        let identity = Matrix3::identity();
        let turn = identity + first * a + second * b;
        let average = identity + first * b + second * c;
        let turned = turn * n;
        let map = LinearMap::Rotation {
            from_rotation: turn,
            from_momentum: average * h,
            made: angle * self.shared.inverse_inertia,
        };
        (map, turned)
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::Rotation3;
    use num_dual::Dual64;

    use super::*;
    use crate::dynamics::{AxisState, Problem};
    use crate::propagation::taylor::scaled_problem::ScaledProblem;
    use crate::propagation::taylor::step_size::Work;

    fn flow() -> LinearisedFlow {
        let spheroid = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.5, constant_c: 0.8 };
        let violation = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, -0.03));
        let vectors = [Vector3::z(), Vector3::new(0.1, 0.2, 1.0)];
        let [axis, momentum] = vectors;
        let problem = Problem::unchecked(spheroid, violation, AxisState { axis, momentum });
        let setup = ScaledProblem::<f64, 2>::new((true, Work::Quadratic), &problem, (0.0, 1.0), 1e-10).unwrap();
        LinearisedFlow::new(&spheroid, &violation, 1.0, SharedRounding::of(&setup).0)
    }

    /// The rotation by `w h` and its mean from the time zero to `h`, on both sides of the angle of a thousandth up to which the
    /// series are used.
    #[test]
    fn rotations_and_their_means_are_those_of_any_angle() {
        let flow = flow();
        let (n, w) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.3, -0.5, 1.2));
        for angle in [1e-6, 1e-4, 9.99e-4, 1.001e-3, 0.03, 0.7, 2.9] {
            let h = angle / w.norm();
            let (map, turned) = flow.rotation(&n, &w, h);
            let LinearMap::Rotation { from_rotation, from_momentum, .. } = map else { panic!("a rotation") };
            let exact = |share: f64| Rotation3::new(w * h * share).into_inner();
            assert!((from_rotation - exact(1.0)).amax() < 2e-16 + 1e-13 * angle * angle, "{angle}");
            assert_relative_eq!(turned, exact(1.0) * n, epsilon = 1e-15);
            // Three Gauss-Legendre points in each of eight parts.
            let mut mean = Matrix3::zeros();
            for part in 0..8 {
                for (place, weight) in [(-0.6_f64.sqrt(), 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.6_f64.sqrt(), 5.0 / 18.0)]
                {
                    mean += exact((f64::from(part) + 0.5 + 0.5 * place) / 8.0) * (weight / 8.0);
                }
            }
            let error = (from_momentum / h - mean).amax();
            // Beyond the series 1 - cos cancels.
            let rounding = if angle < 1e-3 { 2e-15 } else { 2e-16 / angle };
            assert!(error < rounding + 3e-11 * angle.powi(3), "{angle}: {error:e}");
        }
    }

    /// `(x - sin x) / x^3` is the only term in the symmetric part of the mean.
    #[test]
    fn the_series_of_the_mean_of_a_rotation_has_its_second_term() {
        let w = Vector3::new(0.3, -0.5, 1.2);
        let h = 9.99e-4 / w.norm();
        let (map, _) = flow().rotation(&Vector3::z(), &w, h);
        let LinearMap::Rotation { from_momentum, .. } = map else { panic!("a rotation") };
        let square = 9.99e-4_f64.powi(2);
        let exact = 1.0 / 6.0 - square / 120.0 + square * square / 5040.0;
        let found = (from_momentum[(0, 2)] + from_momentum[(2, 0)]) / (2.0 * h * h * h * w.x * w.z);
        assert_relative_eq!(found, exact, max_relative = 3e-11);
    }

    /// A step has five maps for each part of a quarter of a radian of `|w|` and the root of the pull together, from one part to 128 of them.
    #[test]
    fn a_step_has_a_part_for_every_quarter_of_a_radian() {
        let flow = flow();
        let (n, w) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.3, -0.5, 1.2));
        let rate = w.norm() + flow.pull.norm().sqrt();
        for (radians, parts) in [(0.0, 1), (1e-6, 1), (0.24, 1), (-0.26, 2), (1.6, 7), (31.9, 128), (1e6, 128)] {
            let mut maps = 0;
            flow.over((n, w), &n, radians / rate, |_| maps += 1);
            assert_eq!(maps, 5 * parts, "{radians}");
        }
    }

    #[test]
    fn the_last_kick_is_at_the_end() {
        let flow = flow();
        let (n, w) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.3, -0.5, 1.2));
        let end = Vector3::new(0.48, -0.6, 0.64);
        for (radians, parts) in [(0.2, 1.0), (0.45, 2.0)] {
            let h = radians / (w.norm() + flow.pull.norm().sqrt());
            let mut last = Matrix3::zeros();
            flow.over((n, w), &end, h, |map| {
                if let LinearMap::Kick { from_rotation, .. } = map {
                    last = *from_rotation;
                }
            });
            let LinearMap::Kick { from_rotation, .. } = flow.kick(&end, h / parts / 6.0, 0.0).0 else {
                panic!("a kick")
            };
            assert_relative_eq!(last, from_rotation, epsilon = 0.0, max_relative = 1e-14);
        }
    }

    /// The maps are compared with derivatives of `n' = w x n`, `w' = (S n) x n` by the Runge-Kutta method with small steps. The remainder is of the
    /// fifth order in the step, and would be of the third with another correction of the middle kick.
    #[test]
    fn maps_are_those_of_the_linearised_equations_to_the_fourth_order() {
        let pull = Matrix3::from_diagonal(&Vector3::new(0.9, -0.2, -0.7));
        let flow = LinearisedFlow { pull, ..flow() };
        let (n, w) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.3, -0.5, 1.2));
        let (turn, push) = (Vector3::new(0.2, 0.7, -0.4), Vector3::new(-0.6, 0.3, 0.5));
        let h = 0.01;
        let dual = |re: &Vector3<f64>, eps: &Vector3<f64>| re.zip_map(eps, Dual64::new);
        let rates = |[n, w]: [Vector3<Dual64>; 2]| [w.cross(&n), (pull.map(Dual64::from) * n).cross(&n)];
        let along = |state: [Vector3<Dual64>; 2], slope: [Vector3<Dual64>; 2], h: f64| {
            [0, 1].map(|i| state[i] + slope[i] * Dual64::from(h))
        };
        let mut state = [dual(&n, &turn.cross(&n)), dual(&w, &push)];
        for _ in 0..20 {
            let step = h / 20.0;
            let first = rates(state);
            let second = rates(along(state, first, step / 2.0));
            let third = rates(along(state, second, step / 2.0));
            let fourth = rates(along(state, third, step));
            for (slope, weight) in [(first, 1.0), (second, 2.0), (third, 2.0), (fourth, 1.0)] {
                state = along(state, slope, step * weight / 6.0);
            }
        }
        let (mut theta, mut change) = (turn, push);
        flow.over((n, w), &state[0].map(|x| x.re), h, |map| match map {
            LinearMap::Kick { from_rotation, .. } => change += from_rotation * theta,
            LinearMap::Rotation { from_rotation, from_momentum, .. } => {
                theta = from_rotation * theta + from_momentum * change;
            }
        });
        let of_axis = (theta.cross(&state[0].map(|x| x.re)) - state[0].map(|x| x.eps)).amax();
        let of_momentum = (change - state[1].map(|x| x.eps)).amax();
        assert!(of_axis.max(of_momentum) < 3e-11, "{of_axis:e} {of_momentum:e}");
    }
}
