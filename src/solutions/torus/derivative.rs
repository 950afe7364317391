//! Derivatives of the exact motion with respect to a parameter, at a cost that does not depend on time.

use nalgebra::{Matrix3, Vector3};
use num_dual::Dual64;

use super::TorusSolution;
use super::flow::{Axes, Integrals, derivative, joined, tangents};
use super::flow_series::DOUBLE;
use super::torus_of_motion::THINNEST;
use crate::dynamics::{BodyState, Problem, RotationState};
use crate::error::Error;
use crate::numerics::angle::about;
use crate::numerics::scalar::Scalar;

/// Rounding of derivatives that do not grow along the flow, for a torus of the largest width: the rounding of some ten steps of the flow and of their
/// sum.
const ROUNDING: f64 = 3e-14;

/// Number of parts of a closed orbit at whose ends the growth of a change is sampled.
const LOOKS: usize = 16;

/// The exact motion as a function of one parameter: the states of a [`TorusSolution`] with their derivatives.
///
/// After subtracting `m_1` and `m_2` whole turns of the angles of the torus, the rest of the time `t` is less than one cell of the lattice
/// of its periods `(t_i, k_i)`:
///
/// ```text
/// (n, L)(t) = flow of the start by (t, 0) - m_1 (t_1, k_1) - m_2 (t_2, k_2)
/// e_x(t)    = the vector that this flow carries, turned about n by m_1 psi_1 + m_2 psi_2 - epsilon Omega^z t
/// ```
///
/// The flow, its times and the rotation angle are functions of the parameter, the integers are not. A closed orbit returns to the start for any value
/// of the parameter, which determines the derivatives of `t_i`, `k_i` and `psi_i`, by one flow along each orbit. Times are in the unit of time of the
/// problem. See `docs/exact-motion.md`.
#[derive(Debug, Clone)]
pub(crate) struct TorusDerivative<'a> {
    solution: &'a TorusSolution,
    integrals: Integrals<Dual64>,
    start: Axes<Dual64>,
    periods: [[Dual64; 2]; 2],
    /// Derivatives of the rotation angles along both closed orbits, and of the rate of `e_x` about `n` relative to the vector that the flow
    /// of `H` carries.
    turns: [f64; 2],
    spin: f64,
}

impl<'a> TorusDerivative<'a> {
    /// The derivatives for the solution of a problem, given the same problem as a function of one parameter.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for a torus so thin that its two flows are nearly parallel, as in steady motion, whose neighbours have a different
    /// number of frequencies, and if a closed orbit is not finite.
    pub(crate) fn new(solution: &'a TorusSolution, problem: &Problem<Dual64>) -> Result<Self, Error> {
        if solution.width <= THINNEST {
            let why = "the torus is too thin, as where n is along L or L is along an axis of s^IJ";
            return Err(Error::Unsupported { what: "derivatives on the torus", why });
        }
        let (spheroid, coefficients) = (problem.spheroid(), problem.coefficients());
        let torus_from_given = solution.given_from_torus.transpose().map(Dual64::from_re);
        let tensor = torus_from_given * coefficients * torus_from_given.transpose();
        let tensor = tensor - Matrix3::from_diagonal_element(Dual64::from_re(tensor.m22.re));
        let start = problem.initial().rotated(&torus_from_given).vectors();
        let spin = spheroid.rate_about_axis(&start[0], &start[1]);
        let mut found = Self {
            solution,
            integrals: Integrals::new(spheroid, &tensor, Dual64::from_re(solution.spread), DOUBLE),
            start,
            periods: solution.periods.map(|times| times.map(Dual64::from_re)),
            turns: [0.0; 2],
            spin: spin.eps,
        };
        let size = solution.unit;
        let change = joined(&start, size, derivative);
        for (period, turn) in found.periods.iter_mut().zip(&mut found.turns) {
            let mut end = found.integrals.moved(*period, &start);
            let open = change - joined(&end, size, derivative);
            if !open.norm().is_finite() {
                return Err(Error::not_found("periods of the tori next to that of the motion"));
            }
            let rates = found.integrals.both_rates(&end);
            let tangents = tangents(&rates, size);
            let svd = tangents.svd(true, true);
            let slopes =
                svd.solve(&open, f64::EPSILON * svd.singular_values.max()).expect("both factors were asked for");
            for ((time, slope), rates) in period.iter_mut().zip(&slopes).zip(&rates) {
                time.eps = *slope;
                end.iter_mut().zip(rates).for_each(|(end, rate)| *end += rate * Dual64::new(0.0, *slope));
            }
            *turn = about(&end[0], &start[2], &end[2]).eps;
        }
        Ok(found)
    }

    /// Growth of a change of the start along the closed orbits: near an instability, such as the separatrix, rounding grows by as much.
    fn growth(&self) -> f64 {
        let size = |at: &Axes<Dual64>| joined(at, self.solution.unit, derivative).norm();
        let along = |way: &[Dual64; 2]| {
            let part = way.map(|time| Dual64::from_re(time.re / LOOKS as f64));
            let states = core::iter::successors(Some(self.start), |at| Some(self.integrals.moved(part, at)));
            states.take(LOOKS + 1).map(|at| size(&at)).fold(0.0, f64::max)
        };
        self.periods.iter().map(along).fold(0.0, f64::max) / size(&self.start)
    }

    /// The state at the time `t[0] + t[1]` since the start, with its derivative; the values are those of the solution.
    pub(crate) fn state(&self, t: [f64; 2]) -> BodyState<Dual64> {
        let mut times = [Dual64::from_re(0.0); 2];
        let mut turn = Dual64::new(0.0, self.spin * (t[0] + t[1]));
        for ((period, by_parameter), phase) in self.periods.iter().zip(self.turns).zip(&self.solution.phases) {
            let [whole, part] = phase.passed(t);
            turn.eps += whole * by_parameter;
            times.iter_mut().zip(period).for_each(|(time, way)| *time += Dual64::new(part * way.re, -whole * way.eps));
        }
        let given_from_torus = self.solution.given_from_torus.map(Dual64::from_re);
        let [n, momentum, u] = self.integrals.moved(times, &self.start).map(|v| given_from_torus * v);
        let value = self.solution.state(t);
        turn.re = about(&n, &u, &value.equatorial_axis.map(Dual64::from_re)).re;
        let (sin, cos) = turn.sin_cos();
        let changing = [n, momentum, u * cos + n.cross(&u) * sin];
        let both = |value: Vector3<f64>, changing: Vector3<Dual64>| {
            value.zip_map(&changing, |value, changing| Dual64::new(value, changing.eps))
        };
        let [n, momentum, e_x] = value.vectors();
        BodyState {
            axis: both(n, changing[0]),
            momentum: both(momentum, changing[1]),
            equatorial_axis: both(e_x, changing[2]),
        }
    }
}

/// Estimated error of derivatives ([`TorusDerivative`]) with respect to any number of a problem, in units of the largest derivative
/// with respect to the same number:
///
/// ```text
/// 3e-14 g / w
/// ```
///
/// `w` is the width of the torus, the smallest singular value of the rates of `(n, L)` along both flows divided by the rotation rate of the body; `g`
/// is the growth of an arbitrary change of the start along the closed orbits. See `docs/exact-motion.md`.
///
/// # Errors
/// As for [`TorusDerivative::new`].
pub(crate) fn error_of_derivatives(solution: &TorusSolution, problem: &Problem<f64>) -> Result<f64, Error> {
    let [axis, momentum, equatorial_axis] = problem.initial().vectors();
    let changed = |v: &Vector3<f64>, by: Vector3<f64>| v.zip_map(&by, Dual64::new);
    // In body axes, so that a rotation of everything leaves the estimate unchanged.
    let across = axis.cross(&equatorial_axis);
    let turn = equatorial_axis * 0.6 + across * 0.8;
    let start = BodyState {
        axis: changed(&axis, turn.cross(&axis)),
        momentum: changed(&momentum, (axis * 0.48 - equatorial_axis * 0.64 + across * 0.6) * solution.unit),
        equatorial_axis: changed(&equatorial_axis, turn.cross(&equatorial_axis)),
    };
    let problem = problem.map(Dual64::from_re).starting_from(start)?;
    Ok(ROUNDING * TorusDerivative::new(solution, &problem)?.growth() / solution.width)
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    use super::*;
    use crate::dynamics::RigidSpheroid;
    use crate::dynamics::fixture::{ANGLES, RATES, STAR, tensor};
    use crate::parameters::{Parameter, Parameters};
    use crate::propagation::Motion;
    use crate::solutions::steady::fixture::steady_precession;

    fn derivatives(state: &BodyState<Dual64>) -> [Vector3<f64>; 3] {
        state.vectors().map(|v| v.map(|x| x.eps))
    }

    /// Derivatives also with two equal or nearly equal eigenvalues, whose axes rotate with any change, and where the frame of `s` rotates by 1e7 rad
    /// per unit change.
    #[test]
    fn derivatives_are_those_of_the_series_in_time() {
        for s in [[0.02, 0.01, -0.03], [0.2, 0.2, -0.4], [0.2, 0.2 + 1e-11, -0.4], [2e-7, 1e-7, -3e-7]] {
            let start = Parameters::new(STAR, tensor(s), ANGLES, RATES);
            let solution = TorusSolution::new(&start.problem().unwrap(), 1e-15, 40.0).unwrap();
            for parameter in Parameter::OF_MOTION {
                let problem = start.seeded(parameter).problem().unwrap();
                let torus = TorusDerivative::new(&solution, &problem).unwrap();
                let series = problem.taylor((0.0, 40.0), 1e-16).unwrap();
                for t in [0.0, 3.1, 40.0] {
                    let state = torus.state([t, 0.0]);
                    assert_eq!(state.vectors().map(|v| v.map(|x| x.re)), solution.state([t, 0.0]).vectors());
                    let [found, expected] =
                        [state, series.state(Dual64::from_f64(t)).unwrap()].map(|s| derivatives(&s));
                    let size = expected.iter().fold(1e-3, |most: f64, v| most.max(v.amax()));
                    let off = (0..3).fold(0.0, |most: f64, i| most.max((found[i] - expected[i]).amax()));
                    assert!(off < 1e-12 * size, "{s:?}, {parameter:?} at {t}: {off:e} of {size:e}");
                    // The same time in two parts.
                    let parts = derivatives(&torus.state([t - 1.75, 1.75]));
                    let off = (0..3).fold(0.0, |most: f64, i| most.max((parts[i] - expected[i]).amax()));
                    assert!(off < 1e-12 * size, "{s:?}, {parameter:?} at {t} in two parts: {off:e} of {size:e}");
                }
            }
        }
    }

    /// A rotation of everything about Z rotates every state, after any time.
    #[test]
    fn a_turn_of_everything_turns_the_state() {
        let start = Parameters::new(STAR, tensor([0.1, 0.1, -0.2]), ANGLES, RATES);
        let solution = TorusSolution::new(&start.problem().unwrap(), 1e-15, 1e9).unwrap();
        let problem = start.seeded(Parameter::Alpha).problem().unwrap();
        let state = TorusDerivative::new(&solution, &problem).unwrap().state([1e9, 0.1]);
        for (found, v) in derivatives(&state).iter().zip(solution.state([1e9, 0.1]).vectors()) {
            // Rounding in the derivative of a closed orbit, times the number of orbits.
            assert!((found - Vector3::z().cross(&v)).amax() < 1e-15 * 1e9, "{found} {v}");
        }
    }

    /// A steady precession has a series, on a circle, but no derivatives.
    #[test]
    fn a_steady_precession_has_no_torus_of_its_neighbours() {
        for (spin, beta) in [(1.5, ANGLES.beta), (1.1, 0.3), (2.7, 1.2), (-1.9, 2.2), (6.0, 0.9), (0.7, 2.9)] {
            let problem = steady_precession(spin, beta).0;
            let solution = TorusSolution::new(&problem, 1e-12, 1.0).unwrap();
            let height = |t: f64| solution.state([t, 0.0]).axis.z;
            assert!((height(7.3) - beta.cos()).abs() < 1e-12, "{beta}: {}", height(7.3));
            let found = TorusDerivative::new(&solution, &problem.map(Dual64::from_re)).map(|_| ());
            let Err(Error::Unsupported { why, .. }) = found else { panic!("{found:?}") };
            assert!(why.contains("too thin") && solution.width < 1e-8, "{beta}: {why}, {:e}", solution.width);
        }
    }

    /// With `n` at a small angle to `L` the width of the torus is in proportion to the angle, here 0.0267 of it.
    #[test]
    fn a_torus_wider_than_the_thinnest_has_derivatives() {
        for (width, is_there) in [(5e-6, true), (1.1e-8, true), (0.9e-8, false)] {
            let angle: f64 = width / 0.0267;
            let axis = Vector3::new(angle.sin(), 0.0, angle.cos());
            let start = BodyState { axis, momentum: Vector3::z() * 1.7, equatorial_axis: Vector3::y() };
            let problem = Problem::new(STAR, tensor([0.02, 0.01, -0.03]), start).unwrap();
            let solution = TorusSolution::new(&problem, 1e-14, 10.0).unwrap();
            assert_relative_eq!(solution.width, width, max_relative = 1e-2);
            assert_eq!(error_of_derivatives(&solution, &problem).is_ok(), is_there, "{width:e}");
        }
    }

    /// Derivatives near principal axes and separatrices, where they lose digits, for any change of the star, of `s` and of the start. They are
    /// compared with Taylor series.
    #[test]
    fn derivatives_are_as_exact_as_told() {
        let (mut random, mut judged) = (ChaCha8Rng::seed_from_u64(7), 0);
        for k in 0..100 {
            let mut vector = || Vector3::from_fn(|_, _| random.random_range(-0.5..0.5));
            let near =
                |i: usize, by: Vector3<f64>, power: f64| Vector3::ith(i, 1.0) + by * 10f64.powf(6.0 * power - 3.0);
            let [a, b, c, d, e] = [(); 5].map(|()| vector());
            let axis = near(k % 3, vector(), a.x).normalize();
            let momentum = near(k / 3 % 3, vector(), a.y) * (b.x + 0.51);
            let equatorial_axis = axis.cross(&vector()).normalize();
            let s = Matrix3::from_diagonal(&c) * 10f64.powf(4.0 * b.y - 2.0);
            let star = RigidSpheroid::in_units_of_tc(1.3 + 0.5 * b.z);
            let problem = Problem::new(star, s, BodyState { axis, momentum, equatorial_axis }).unwrap();
            // Near the separatrix some are refused.
            let Ok(solution) = TorusSolution::new(&problem, 1e-14, 10.0) else { continue };
            let Ok(estimate) = error_of_derivatives(&solution, &problem) else { continue };
            let by = |v: &Vector3<f64>, change: Vector3<f64>| v.zip_map(&change, Dual64::new);
            let changed = Problem::new(
                RigidSpheroid { inertia_zz: Dual64::new(star.inertia_zz, d.x), ..star.map(Dual64::from_re) },
                s.zip_map(&(Matrix3::new(d.y, e.x, e.y, e.x, d.z, e.z, e.y, e.z, -d.y - d.z) * s.norm()), Dual64::new),
                BodyState {
                    axis: by(&axis, d.cross(&axis)),
                    momentum: by(&momentum, e),
                    equatorial_axis: by(&equatorial_axis, d.cross(&equatorial_axis)),
                },
            );
            let changed = changed.unwrap();
            let torus = TorusDerivative::new(&solution, &changed).unwrap();
            let series = changed.taylor((0.0, 10.0), 1e-16).unwrap();
            for t in [1.3, 4.1, 7.7, 10.0] {
                let [found, expected] =
                    [torus.state([t, 0.0]), series.state(Dual64::from_re(t)).unwrap()].map(|state| derivatives(&state));
                let size = expected.iter().fold(0.0, |most: f64, v| most.max(v.amax()));
                let off = (0..3).fold(0.0, |most: f64, i| most.max((found[i] - expected[i]).amax()));
                assert!(off < estimate * size, "{k}, {t}: {off:e} of {size:e}, estimated {estimate:e}");
            }
            judged += 1;
        }
        assert!(judged > 75, "{judged}");
    }
}
