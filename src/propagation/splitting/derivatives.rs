//! States at given times with their derivatives with respect to parameters of the scene.

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual64;

use crate::dynamics::{BodyState, Problem, RotationState};
use crate::error::Error;
use crate::numerics::registers::Register;
use crate::numerics::ring::FusedDouble;
use crate::numerics::side_by_side::SideBySide;
use crate::propagation::input::check_request;
use crate::propagation::splitting::choice::{Goal, SplittingForecast, TANGENTS_AT_ONCE, cheapest};
use crate::propagation::splitting::flows::{AXIS, COMPANION, Moving, RATE};
use crate::propagation::splitting::motion::{PrincipalProblem, SPLITTING_STEP_LIMIT};
use crate::propagation::splitting::scheme::Scheme;
use crate::propagation::splitting::stepper::{Steps, angles};
use crate::propagation::splitting::tangents::{Tangents, WithTangents};
use crate::propagation::third_angle::body_state;

/// The derivatives of a problem that the flows need, in the principal frame.
struct Seed<const V: usize> {
    vectors: [Vector3<f64>; V],
    tensor: Matrix3<f64>,
}

/// Number of directions in one register.
const LANES: usize = 4;

/// The states at `times` (in the order in which the motion reaches them) with their derivatives with respect to the parameter of each of the
/// `seeded` problems, which have the same values; `e_x` is zero if it is not carried. `None` if the processor lacks the instructions, or if there
/// are no scenes or times.
///
/// One motion by splitting is computed for every [`TANGENTS_AT_ONCE`] parameters, with the tangent map of each of its flows: its derivatives
/// are those of the numerical motion to rounding.
///
/// # Errors
/// As for [`Problem::splitting`].
pub(crate) fn states_with_derivatives<X: RotationState<Dual64>>(
    seeded: &[Problem<Dual64, X>],
    start: f64,
    times: &[f64],
    tolerance: f64,
) -> Result<Option<Vec<Vec<BodyState<Dual64>>>>, Error> {
    if const { X::VECTORS == 3 } {
        states_of::<X, 3>(seeded, start, times, tolerance)
    } else {
        states_of::<X, 2>(seeded, start, times, tolerance)
    }
}

fn states_of<X: RotationState<Dual64>, const V: usize>(
    seeded: &[Problem<Dual64, X>],
    start: f64,
    times: &[f64],
    tolerance: f64,
) -> Result<Option<Vec<Vec<BodyState<Dual64>>>>, Error> {
    let (Some(register), Some(first), Some(last)) = (pulp::x86::V3::try_new(), seeded.first(), times.last()) else {
        return Ok(None);
    };
    check_request((start, *last), tolerance)?;
    let scene = PrincipalProblem::<V>::new(&first.map(|value| value.re))?;
    let SplittingForecast { scheme, step, steps, .. } = cheapest(&scene, (start, *last), tolerance, Goal::Derivatives);
    // Each of the times may split a step in two.
    let count = steps + times.len() as f64;
    Error::ensure(count <= SPLITTING_STEP_LIMIT, "number of steps", count, "at most 1e10")?;
    let mut found = vec![Vec::with_capacity(seeded.len()); times.len()];
    for seeded in seeded.chunks(TANGENTS_AT_ONCE) {
        let moving = Derivatives { scene: &scene, scheme, step, start, times, seeded };
        register.run(
            #[inline(always)]
            || match seeded.len().div_ceil(LANES) {
                1 => moving.follow::<_, 1>(register, &mut found),
                2 => moving.follow::<_, 2>(register, &mut found),
                3 => moving.follow::<_, 3>(register, &mut found),
                _ => moving.follow::<_, 4>(register, &mut found),
            },
        );
    }
    Ok(Some(found))
}

/// A motion to be computed with its derivatives.
struct Derivatives<'a, X, const V: usize> {
    scene: &'a PrincipalProblem<V>,
    scheme: &'static Scheme,
    /// Longest step.
    step: f64,
    start: f64,
    times: &'a [f64],
    seeded: &'a [Problem<Dual64, X>],
}

impl<X: RotationState<Dual64>, const V: usize> Derivatives<'_, X, V> {
    #[inline(always)]
    fn follow<R: Register, const N: usize>(&self, register: R, found: &mut [Vec<BodyState<Dual64>>]) {
        let scene = self.scene;
        let mut moving = WithTangents {
            state: scene.start.convert(),
            tangents: self.tangents::<R, N>(register),
            sigma: scene.field.tensor.map(|value| value * scene.field.strength),
        };
        let mut before = self.start;
        for (&time, found) in self.times.iter().zip(found) {
            let interval = time - before;
            let count = (interval.abs() / self.step).ceil();
            if count > 0.0 {
                let steps = {
                    let step = interval / count;
                    let angles = angles(self.scheme, step.abs() * scene.largest_rate);
                    Steps::turning(self.scheme, &scene.field.convert(), FusedDouble(step), angles)
                };
                steps.open(&mut moving);
                steps.advance(&mut moving, FusedDouble(scene.casimir), count as u64);
                steps.close(&mut moving);
            }
            let states = self.seeded.iter().enumerate().map(|(place, seeded)| {
                let derivative = |v: &[SideBySide<R, N>; 3]| v.each_ref().map(|component| component.get(place));
                let derivatives = moving.tangents.vectors.each_ref().map(derivative);
                self.body_state(seeded, &moving.state.convert(), derivatives, time - self.start)
            });
            found.extend(states);
            before = time;
        }
    }

    /// The derivatives at the start.
    #[inline(always)]
    fn tangents<R: Register, const N: usize>(&self, register: R) -> Tangents<SideBySide<R, N>, V> {
        let seeds: Vec<Seed<V>> = self.seeded.iter().map(|seeded| self.seed(seeded)).collect();
        let gather = |value: &dyn Fn(&Seed<V>) -> f64| {
            SideBySide::<R, N>::gather(register, |place| seeds.get(place).map_or(0.0, value))
        };
        let vector = |v: usize| [0, 1, 2].map(|i| gather(&|seed| seed.vectors[v][i]));
        let places = [(0, 0), (1, 1), (2, 2), (1, 2), (2, 0), (0, 1)];
        Tangents {
            vectors: core::array::from_fn(vector),
            tensor: places.map(|place| gather(&|seed| seed.tensor[place])),
        }
    }

    fn seed(&self, seeded: &Problem<Dual64, X>) -> Seed<V> {
        let (turn, spheroid) = (self.scene.principal_from_given, seeded.spheroid());
        let sigma = seeded.coefficients() * (spheroid.constant_c * 2.0 / spheroid.inertia_xx);
        let mut vectors = seeded.start::<V>();
        vectors[RATE] /= spheroid.inertia_xx;
        Seed {
            vectors: vectors.map(|v| turn * v.map(|value| value.eps)),
            tensor: turn * sigma.map(|value| value.eps) * turn.transpose(),
        }
    }

    /// The state of the body, as a function of the parameter of a seeded problem.
    fn body_state(
        &self,
        seeded: &Problem<Dual64, X>,
        state: &Moving<f64, V>,
        derivatives: [[f64; 3]; V],
        elapsed: f64,
    ) -> BodyState<Dual64> {
        let back = self.scene.principal_from_given.transpose();
        let vector = |v: usize| {
            let (value, derivative) = (back * Vector3::from(state.vectors[v]), back * Vector3::from(derivatives[v]));
            value.zip_map(&derivative, Dual64::new)
        };
        let (axis, momentum) = (vector(AXIS), vector(RATE) * seeded.spheroid().inertia_xx);
        if V <= COMPANION {
            return BodyState { axis, momentum, equatorial_axis: Vector3::zeros() };
        }
        let start = seeded.initial().axis_state();
        let rate = seeded.spheroid().rate_about_axis(&start.axis, &start.momentum);
        body_state([axis, momentum, vector(COMPANION)], rate * elapsed)
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::dynamics::RigidSpheroid;
    use crate::solutions::free::rotated_by;

    /// A scene with derivatives of all its numbers, different for each `direction`.
    fn seeded(direction: usize, s: f64, momentum: f64) -> Problem<Dual64> {
        let slope = |place: usize| ((7 * direction + 3 * place + 1) as f64).sin();
        let dual = |value: f64, place: usize| Dual64::new(value, slope(place));
        let vector = |[x, y, z]: [f64; 3], place| Vector3::new(dual(x, place), dual(y, place + 1), dual(z, place + 2));
        let entry = |i: usize, j: usize| if i == j { [0.2, 0.1, -0.3][i] } else { 0.02 * (i + j) as f64 };
        let body = RigidSpheroid { inertia_xx: dual(1.3, 0), inertia_zz: dual(1.1, 1), constant_c: dual(0.7, 2) };
        let momentum = vector([0.3, -0.7, 1.1].map(|x| momentum * x), 13);
        let vectors = [vector([0.6, 0.0, 0.8], 10), momentum, vector([0.0, 1.0, 0.0], 16)];
        let tensor = Matrix3::from_fn(|i, j| dual(s * entry(i, j), 3 + i + j));
        Problem::new(body, tensor, BodyState::from_vectors(vectors)).unwrap()
    }

    fn numbers(state: &BodyState<Dual64>) -> Vec<(f64, f64)> {
        [state.axis, state.momentum, state.equatorial_axis].iter().flatten().map(|x| (x.re, x.eps)).collect()
    }

    #[test]
    fn a_derivative_does_not_depend_on_those_beside_it() {
        let seeds: Vec<_> = (0..17).map(|direction| seeded(direction, 1.0, 1.0)).collect();
        let of = |seeds: &[Problem<Dual64>]| states_with_derivatives(seeds, 1.0, &[2.0, 5.5], 1e-5).unwrap();
        let Some(together) = of(&seeds) else { return };
        for (place, seeded) in seeds.iter().enumerate() {
            let alone = of(core::slice::from_ref(seeded)).unwrap();
            for (alone, together) in alone.iter().zip(&together) {
                assert_eq!(numbers(&alone[0]), numbers(&together[place]), "{place}");
            }
        }
    }

    /// Without torque the flows are exact: at each time the only error is rounding, however large the angles of a step.
    #[test]
    fn free_rotation_and_its_derivatives_are_exact_both_ways() {
        let seeded = seeded(3, 0.0, 15.0);
        let seeded = Problem::new(*seeded.spheroid(), Matrix3::zeros(), *seeded.initial()).unwrap();
        let BodyState { axis, momentum, .. } = *seeded.initial();
        for way in [1.0, -1.0] {
            let times = [0.01, 0.02, 2.5, 5.0].map(|elapsed| 1.0 + way * elapsed);
            let Some(found) = states_with_derivatives(&[seeded], 1.0, &times, 1e-3).unwrap() else { return };
            for (states, time) in found.iter().zip(times) {
                let turn = momentum * (Dual64::from_re(time - 1.0) / seeded.spheroid().inertia_xx);
                for (found, exact) in states[0].axis.iter().zip(&rotated_by(&turn, &axis)) {
                    assert_relative_eq!(found.re, exact.re, epsilon = 2e-13);
                    assert_relative_eq!(found.eps, exact.eps, epsilon = 1e-11);
                }
            }
        }
    }

    #[test]
    fn the_steps_that_are_refused_are_those_of_the_motion_and_of_its_samples() {
        let seeded = seeded(0, 1.0, 1.0);
        let scene = PrincipalProblem::<2>::new(&seeded.map(|x| x.re)).unwrap();
        for end in [2e12, -2e12] {
            let step = cheapest(&scene, (0.0, end), 1e-5, Goal::Derivatives).step;
            match states_with_derivatives(&[seeded], 0.0, &[0.5 * end, 0.7 * end, end], 1e-5) {
                Err(Error::Domain { value, .. }) => assert!((value - (2e12 / step).ceil() - 3.0).abs() < 0.5),
                Ok(found) => assert!(found.is_none(), "no registers"),
                Err(other) => panic!("{other}"),
            }
        }
    }
}
