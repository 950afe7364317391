//! Initial values from the constants of integration, Eq. (34), and the constants from initial values.

use core::f64::consts::PI;

use nalgebra::{Matrix2, Vector2};
use num_dual::Dual64;

use crate::dynamics::RigidSpheroid;
use crate::dynamics::euler_angle_equations::AxisAngles;
use crate::error::Error;
use crate::lorentz_violation::PrincipalCoefficients;
use crate::numerics::angle::whole_turns;
use crate::numerics::scalar::{Real, Scalar};
use crate::solutions::perturbation::{Constants, Form, Perturbation, Precession};

/// Constants of integration of the perturbation solution with given initial values: the inverse of [`Perturbation::at`] at time zero, in the
/// printed form of Eq. (34) `[integraltoinitial]`.
///
/// `A cos phi` and `A sin phi` follow directly from the rates; `alpha_0`, `beta_0` are found by Newton's method with exact derivatives,
/// started at the initial angles and at a grid of inclinations. Eq. (34) is not linear, so there can be several solutions: of those found,
/// the one with the smallest `|A|` is returned, with `A >= 0` and `phi` from -pi to pi, `phi = 0` if `A = 0`. One with a smaller `|A|` may be
/// missed, above all for a large asymmetry of `s^IJ`. Residual: a few ulp of the terms of Eq. (34). Derivatives (duals) of the constants are
/// correct up to third order, except for `A` and `phi` at `A = 0`.
///
/// # Errors
/// [`Error::NotConverged`] if no start leads to a solution, as happens if the perturbation solutions do not describe the
/// motion; [`Error::Domain`] for zero spin.
pub fn constants_from_initial_values<S: Real>(
    form: Form,
    kind: Precession,
    spheroid: &RigidSpheroid<S>,
    s: &PrincipalCoefficients<S>,
    spin: S,
    initial: &AxisAngles<S>,
) -> Result<Constants<S>, Error> {
    Error::ensure(spin.re() != 0.0, "spin Omega^z", spin.re(), "nonzero; Eq. (34) divides by it")?;
    // Eq. (34) is periodic in alpha with a full turn: near zero Newton's method loses no digits of alpha.
    let turns = whole_turns(initial.alpha.re());
    let initial = &AxisAngles { alpha: initial.alpha - S::from_f64(turns), ..*initial };
    let generic = Inversion { form, kind, spheroid: *spheroid, s: *s, spin, initial: *initial };
    let Root { point, inverse } = generic.map(S::re).solve()?;
    let mut found = point.map(S::from_f64);
    // Each step with the real inverse makes the derivatives correct to one more order.
    for _ in 0..3 {
        found -= inverse.map(S::from_f64) * generic.residual(&found);
    }
    let (p, q) = generic.homogeneous(&found);
    let (amplitude, phase) =
        if p.re() == 0.0 && q.re() == 0.0 { (S::zero(), S::zero()) } else { ((p * p + q * q).sqrt(), q.atan2(p)) };
    Ok(Constants { alpha_0: found.x + S::from_f64(turns), beta_0: found.y, amplitude, phase })
}

/// Eq. (34) as two equations for `(alpha_0, beta_0)`.
struct Inversion<S> {
    form: Form,
    kind: Precession,
    spheroid: RigidSpheroid<S>,
    s: PrincipalCoefficients<S>,
    spin: S,
    initial: AxisAngles<S>,
}

struct Root {
    point: Vector2<f64>,
    /// Inverse of the Jacobian there.
    inverse: Matrix2<f64>,
}

impl<S: Scalar> Inversion<S> {
    /// The same numbers in another type.
    fn map<T>(&self, to: impl Fn(S) -> T) -> Inversion<T> {
        let AxisAngles { alpha, beta, alpha_rate, beta_rate } = self.initial;
        Inversion {
            form: self.form,
            kind: self.kind,
            spheroid: self.spheroid.map(&to),
            s: self.s.map(&to),
            spin: to(self.spin),
            initial: AxisAngles {
                alpha: to(alpha),
                beta: to(beta),
                alpha_rate: to(alpha_rate),
                beta_rate: to(beta_rate),
            },
        }
    }

    fn at(&self, x: &Vector2<S>, amplitude: S, phase: S) -> Perturbation<S> {
        let constants = Constants { alpha_0: x.x, beta_0: x.y, amplitude, phase };
        Perturbation::new_unchecked(self.form, self.kind, &self.spheroid, &self.s, self.spin, &constants)
    }

    /// `(A cos phi, A sin phi)` from the third and fourth lines of Eq. (34).
    fn homogeneous(&self, x: &Vector2<S>) -> (S, S) {
        let forced = self.at(x, S::zero(), S::zero());
        let (alpha_rate, beta_rate) = forced.first_order_rates(S::zero(), x.x);
        let p = self.initial.beta_rate - beta_rate;
        let q = (forced.rate + alpha_rate - self.initial.alpha_rate) / forced.homogeneous_ratio;
        (p, q)
    }

    /// First and second lines of Eq. (34), right side minus left side.
    fn residual(&self, x: &Vector2<S>) -> Vector2<S> {
        let forced = self.at(x, S::zero(), S::zero());
        let (p, q) = self.homogeneous(x);
        let (alpha, beta) = forced.first_order(S::zero(), x.x);
        let nu = forced.homogeneous_frequency;
        Vector2::new(
            x.x + alpha + forced.homogeneous_ratio * p / nu - self.initial.alpha,
            x.y + beta + q / nu - self.initial.beta,
        )
    }
}

impl Inversion<f64> {
    const STARTS: usize = 64;
    const ITERATIONS: usize = 60;

    fn jacobian(lifted: &Inversion<Dual64>, x: &Vector2<f64>) -> Matrix2<f64> {
        let column = |i: usize| {
            let mut point = x.map(Dual64::from);
            point[i].eps = 1.0;
            lifted.residual(&point).map(|r| r.eps)
        };
        Matrix2::from_columns(&[column(0), column(1)])
    }

    fn solve(&self) -> Result<Root, Error> {
        let lifted = self.map(Dual64::from_re);
        let grid = (0..Self::STARTS).map(|i| PI * (i as f64 + 0.5) / Self::STARTS as f64);
        core::iter::once(self.initial.beta)
            .chain(grid)
            .filter_map(|beta| self.newton(&lifted, Vector2::new(self.initial.alpha, beta)))
            .map(|root| {
                let (p, q) = self.homogeneous(&root.point);
                (p.hypot(q), root)
            })
            .min_by(|(a, _), (b, _)| a.total_cmp(b))
            .map(|(_, root)| root)
            .ok_or(Error::NotConverged {
                what: "constants from initial values, Eq. (34)",
                iterations: Self::ITERATIONS,
                residual: self.residual(&Vector2::new(self.initial.alpha, self.initial.beta)).norm(),
            })
    }

    /// Newton's method with steps of at most 0.2 rad, restricted to inclinations inside (0, pi).
    fn newton(&self, lifted: &Inversion<Dual64>, start: Vector2<f64>) -> Option<Root> {
        let mut x = start;
        for _ in 0..Self::ITERATIONS {
            let jacobian = Self::jacobian(lifted, &x);
            let step = jacobian.try_inverse()? * self.residual(&x);
            let size = step.norm();
            x -= step * (0.2 / size).min(1.0);
            let inside = x.y > 0.0 && x.y < PI;
            if !size.is_finite() || !inside {
                return None;
            }
            if size < 1e-12 {
                return Some(Root { point: x, inverse: Self::jacobian(lifted, &x).try_inverse()? });
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use num_dual::Dual3_64;

    use super::*;

    fn body<S: Scalar>(inertia_zz: f64, constant_c: f64) -> RigidSpheroid<S> {
        let [inertia_xx, inertia_zz, constant_c] = [1.0, inertia_zz, constant_c].map(S::from_f64);
        RigidSpheroid { inertia_xx, inertia_zz, constant_c }
    }

    fn coefficients<S: Scalar>(values: [f64; 3]) -> PrincipalCoefficients<S> {
        PrincipalCoefficients::new(values.map(S::from_f64))
    }

    fn angles<S>([alpha, beta, alpha_rate, beta_rate]: [S; 4]) -> AxisAngles<S> {
        AxisAngles { alpha, beta, alpha_rate, beta_rate }
    }

    type Body<S> = (RigidSpheroid<S>, PrincipalCoefficients<S>);

    /// The initial values of the printed solution with unit spin.
    fn start<S: Real>(kind: Precession, (spheroid, s): &Body<S>, constants: &Constants<S>) -> AxisAngles<S> {
        Perturbation::new(Form::Printed, kind, spheroid, s, S::one(), constants).unwrap().at(S::zero())
    }

    /// The constants of integration for these initial values.
    fn constants(kind: Precession, body: &Body<f64>, initial: [f64; 4]) -> Constants<f64> {
        let initial = angles(initial);
        let found = constants_from_initial_values(Form::Printed, kind, &body.0, &body.1, 1.0, &initial).unwrap();
        let again = start(kind, body, &found);
        for (found, exact) in [
            (again.alpha, initial.alpha),
            (again.beta, initial.beta),
            (again.alpha_rate, initial.alpha_rate),
            (again.beta_rate, initial.beta_rate),
        ] {
            assert_relative_eq!(found, exact, max_relative = 1e-12, epsilon = 1e-13);
        }
        found
    }

    /// Here only one inclination of the grid leads to the solution of the smallest `|A|`: the first in one case, the last in the other. The
    /// solutions with the next larger `|A|` have 0.26 and 0.88.
    #[test]
    fn the_grid_of_starts_reaches_both_poles() {
        for (inertia_zz, s, initial, amplitude) in [
            (1.42, [0.044, -0.049, -0.018], [-1.24, 0.123, 1.77, 0.08], 0.15),
            (1.67, [-0.026, 0.069, 0.062], [-0.23, 2.99, -0.28, 0.78], 0.82),
        ] {
            let found = constants(Precession::Single, &(body(inertia_zz, 1.0), coefficients(s)), initial);
            assert!(found.amplitude < amplitude, "{found:?}");
        }
    }

    /// Without Lorentz violation and with the rates of free precession the first equation is linear: steps of 0.2, one for the rest, and
    /// one that finds nothing left to do. An error of the inclination leaves its square, which must be below 1e-12.
    #[test]
    fn sixty_steps_are_enough_or_not() {
        let (alpha, beta) = (0.4, 0.9_f64);
        let inversion = Inversion {
            form: Form::Printed,
            kind: Precession::Twofold,
            spheroid: body(1.1, 0.0),
            s: coefficients([0.0; 3]),
            spin: 1.0,
            initial: angles([alpha, beta, 1.1 / beta.cos(), 0.0]),
        };
        let lifted = inversion.map(Dual64::from_re);
        let from = |distance: f64, off: f64| inversion.newton(&lifted, Vector2::new(alpha + distance, beta + off));
        for (distance, off) in [(11.7, 0.0), (-11.7, 0.0), (11.5, 5.2e-4), (0.0, 0.0)] {
            let root = from(distance, off).expect("converges").point;
            assert!((root - Vector2::new(alpha, beta)).amax() < 1e-14, "{root}");
        }
        for (distance, off) in [(11.9, 0.0), (-11.9, 0.0), (11.7, 5.2e-4), (0.0, 3.0)] {
            assert!(from(distance, off).is_none(), "{distance} {off}");
        }
    }

    /// At `alpha = 0` and `beta' = 0` the forced motion has the same values, so that `cos phi` vanishes, but `A` does not.
    #[test]
    fn a_phase_of_a_quarter_turn_is_no_vanishing_amplitude() {
        for alpha_rate in [1.3, 1.9] {
            let body = (body(1.1, 0.3), coefficients([0.02, 0.01, -0.04]));
            let found = constants(Precession::Twofold, &body, [0.0, 0.8, alpha_rate, 0.0]);
            assert_eq!(found.alpha_0, 0.0);
            assert_relative_eq!(found.phase.abs(), PI / 2.0, max_relative = 1e-15);
            assert!(found.amplitude > 0.05, "{found:?}");
        }
    }

    /// Where `A` vanishes, the root and the angle have no derivatives, and none are returned.
    #[test]
    fn a_vanishing_amplitude_has_no_phase_and_no_derivatives() {
        // With omega equal to one the quotients of duals are those of doubles.
        let initial = [0.4, 0.9, 1.0 / 0.9_f64.sin_cos().1, 0.0];
        let found = constants(Precession::Twofold, &(body(1.0, 0.0), coefficients([0.0; 3])), initial);
        assert_eq!((found.amplitude, found.phase), (0.0, 0.0));
        let lift = |value: f64| Dual64::new(value, 1.0);
        let (spheroid, s, varied) = (body(1.0, 0.0), coefficients([0.0; 3]), angles(initial.map(lift)));
        let found =
            constants_from_initial_values(Form::Printed, Precession::Twofold, &spheroid, &s, lift(1.0), &varied)
                .unwrap();
        assert_eq!((found.amplitude, found.phase), (Dual64::from(0.0), Dual64::from(0.0)));
        assert!(found.alpha_0.eps.is_finite() && found.beta_0.eps != 0.0);
    }

    /// The residual of Eq. (34) at the initial angles, from its own right side.
    #[test]
    fn what_does_not_converge_tells_how_far_it_is() {
        let body = (body(0.75, 1.0), coefficients([-0.1, 1.06, 1.57]));
        let initial = angles([1.13, 0.61, 0.25, 0.71]);
        let at = |amplitude: f64, phase: f64| {
            let constants = Constants { alpha_0: initial.alpha, beta_0: initial.beta, amplitude, phase };
            start(Precession::Single, &body, &constants)
        };
        let forced = at(0.0, 0.0);
        let p = initial.beta_rate - forced.beta_rate;
        let q = -(forced.alpha_rate - initial.alpha_rate) * initial.beta.sin();
        let there = at(p.hypot(q), q.atan2(p));
        assert_relative_eq!(there.alpha_rate, initial.alpha_rate, max_relative = 1e-12);
        let left = (there.alpha - initial.alpha).hypot(there.beta - initial.beta);
        match constants_from_initial_values(Form::Printed, Precession::Single, &body.0, &body.1, 1.0, &initial) {
            Err(Error::NotConverged { iterations, residual, .. }) => {
                assert_eq!(iterations, 60);
                assert_relative_eq!(residual, left, max_relative = 1e-12);
            }
            other => panic!("{other:?}"),
        }
    }

    /// Constants that are linear in one variable are recovered with vanishing second and third derivatives.
    #[test]
    fn derivatives_hold_up_to_the_third_order() {
        let linear = |value: f64, slope: f64| Dual3_64::new(value, slope, 0.0, 0.0);
        let (alpha_0, beta_0) = (linear(0.3, 0.7), linear(0.7, -0.4));
        let exact = Constants { alpha_0, beta_0, amplitude: linear(0.2, 0.1), phase: linear(0.5, 0.9) };
        let (kind, one) = (Precession::Twofold, Dual3_64::from(1.0));
        let body = (body(1.1, 0.3), coefficients([0.02, 0.01, -0.04]));
        let initial = start(kind, &body, &exact);
        let found = constants_from_initial_values(Form::Printed, kind, &body.0, &body.1, one, &initial).unwrap();
        for (found, exact) in [
            (found.alpha_0, exact.alpha_0),
            (found.beta_0, exact.beta_0),
            (found.amplitude, exact.amplitude),
            (found.phase, exact.phase),
        ] {
            let Dual3_64 { re, v1, v2, v3, .. } = found - exact;
            assert!([re, v1, v2, v3].iter().all(|error| error.abs() < 1e-10), "{found} {exact}");
        }
    }
}
