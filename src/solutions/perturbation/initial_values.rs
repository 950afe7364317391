//! Initial values from the constants of integration, Eq. (34), and the constants from initial values.

use core::f64::consts::{PI, TAU};

use nalgebra::{Matrix2, Vector2};
use num_dual::Dual64;

use crate::dynamics::RigidSpheroid;
use crate::dynamics::euler_angle_equations::AxisAngles;
use crate::error::Error;
use crate::lorentz_violation::PrincipalCoefficients;
use crate::scalar::{Real, Scalar};
use crate::solutions::perturbation::{Constants, Kind, Perturbation};

/// Initial angles and rates of the printed solution, Eq. (34) `[integraltoinitial]`: [`Perturbation::at`] zero.
///
/// # Errors
/// As for [`Perturbation::printed`].
pub fn initial_values<S: Real>(
    kind: Kind,
    spheroid: &RigidSpheroid<S>,
    s: &PrincipalCoefficients<S>,
    spin: S,
    constants: &Constants<S>,
) -> Result<AxisAngles<S>, Error> {
    Ok(Perturbation::printed(kind, spheroid, s, spin, constants)?.at(S::zero()))
}

/// Constants of integration of the printed solution that has given initial values: the inverse of Eq. (34)
/// `[integraltoinitial]`.
///
/// `A cos phi` and `A sin phi` follow directly; `alpha_0`, `beta_0` by Newton's method with exact derivatives, started at
/// the initial angles and at a grid of inclinations. Eq. (34) is not linear, so there can be several solutions: of those
/// found, the one with the smallest `|A|` is returned, with `A >= 0` and `phi` in (-pi, pi], `phi = 0` if `A = 0`. Residual: a few ulp of the
/// terms of Eq. (34). Derivatives (duals) of the constants hold up to third order, except of `A` and `phi` at `A = 0`.
///
/// # Errors
/// [`Error::NotConverged`] if no start leads to a solution, as happens where the perturbation solutions do not describe the
/// motion; [`Error::Domain`] for zero spin.
pub fn constants_from_initial_values<S: Real>(
    kind: Kind,
    spheroid: &RigidSpheroid<S>,
    s: &PrincipalCoefficients<S>,
    spin: S,
    initial: &AxisAngles<S>,
) -> Result<Constants<S>, Error> {
    Error::unless(spin.re() != 0.0, "spin Omega^z", spin.re(), "nonzero: Eq. (34) divides by it")?;
    // Eq. (34) repeats itself after a turn of alpha: near zero Newton's method loses no digits to it.
    let whole_turns = (initial.alpha.re() / TAU).round() * TAU;
    let initial = &AxisAngles { alpha: initial.alpha - S::from_f64(whole_turns), ..*initial };
    let real = Inversion {
        kind,
        spheroid: RigidSpheroid {
            inertia_xx: spheroid.inertia_xx.re(),
            inertia_zz: spheroid.inertia_zz.re(),
            constant_c: spheroid.constant_c.re(),
        },
        s: PrincipalCoefficients { xx: s.xx.re(), yy: s.yy.re(), zz: s.zz.re() },
        spin: spin.re(),
        initial: AxisAngles {
            alpha: initial.alpha.re(),
            beta: initial.beta.re(),
            alpha_rate: initial.alpha_rate.re(),
            beta_rate: initial.beta_rate.re(),
        },
    };
    let (mut found, jacobian) = real.solve()?.into_generic::<S>();
    let inverse = jacobian.try_inverse().ok_or(Error::NotConverged {
        what: "constants from initial values, Eq. (34)",
        iterations: 0,
        residual: 0.0,
    })?;
    let generic = Inversion { kind, spheroid: *spheroid, s: *s, spin, initial: *initial };
    // Each step with the real inverse makes the derivatives right to one more order.
    for _ in 0..3 {
        found -= inverse.map(S::from_f64) * generic.residual(&found);
    }
    let (p, q) = generic.homogeneous(&found);
    let (amplitude, phase) =
        if p.re() == 0.0 && q.re() == 0.0 { (S::zero(), S::zero()) } else { ((p * p + q * q).sqrt(), q.atan2(p)) };
    Ok(Constants { alpha_0: found.x + S::from_f64(whole_turns), beta_0: found.y, amplitude, phase })
}

/// Eq. (34) as two equations for `(alpha_0, beta_0)`.
struct Inversion<S> {
    kind: Kind,
    spheroid: RigidSpheroid<S>,
    s: PrincipalCoefficients<S>,
    spin: S,
    initial: AxisAngles<S>,
}

struct Root {
    point: Vector2<f64>,
    jacobian: Matrix2<f64>,
}

impl Root {
    fn into_generic<S: Scalar>(self) -> (Vector2<S>, Matrix2<f64>) {
        (self.point.map(S::from_f64), self.jacobian)
    }
}

impl<S: Scalar> Inversion<S> {
    fn at(&self, x: &Vector2<S>, amplitude: S, phase: S) -> Perturbation<S> {
        let constants = Constants { alpha_0: x.x, beta_0: x.y, amplitude, phase };
        Perturbation::printed_unchecked(self.kind, &self.spheroid, &self.s, self.spin, &constants)
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

    fn lifted(&self) -> Inversion<Dual64> {
        let lift = Dual64::from_f64;
        Inversion {
            kind: self.kind,
            spheroid: RigidSpheroid {
                inertia_xx: lift(self.spheroid.inertia_xx),
                inertia_zz: lift(self.spheroid.inertia_zz),
                constant_c: lift(self.spheroid.constant_c),
            },
            s: PrincipalCoefficients { xx: lift(self.s.xx), yy: lift(self.s.yy), zz: lift(self.s.zz) },
            spin: lift(self.spin),
            initial: AxisAngles {
                alpha: lift(self.initial.alpha),
                beta: lift(self.initial.beta),
                alpha_rate: lift(self.initial.alpha_rate),
                beta_rate: lift(self.initial.beta_rate),
            },
        }
    }

    fn jacobian(lifted: &Inversion<Dual64>, x: &Vector2<f64>) -> Matrix2<f64> {
        let column = |i: usize| {
            let mut point = x.map(Dual64::from);
            point[i].eps = 1.0;
            lifted.residual(&point).map(|r| r.eps)
        };
        Matrix2::from_columns(&[column(0), column(1)])
    }

    fn solve(&self) -> Result<Root, Error> {
        let lifted = self.lifted();
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

    /// Newton's method with steps of at most 0.2 rad, kept to inclinations inside (0, pi).
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
                return Some(Root { point: x, jacobian: Self::jacobian(lifted, &x) });
            }
        }
        None
    }
}
