//! Any axisymmetric density: mass, inertia, tensor of the gravitational energy and C by multipoles. Eqs. (12), (15)-(17).
//!
//! The potential is expanded in Legendre polynomials, `Phi = -sum_l phi_l(r) P_l(mu)`, `mu = cos(theta)`. With
//! `U^xx - U^zz = int rho D Phi d^3x`, `D = (varpi d_varpi) / 2 - z d_z = -P_2 r d_r - (3/2) mu (1 - mu^2) d_mu`, and the
//! angular moments at radius `r`
//!
//! ```text
//! M_l = int rho P_l dmu,   J_l = int rho P_2 P_l dmu,   K_l = (3/2) int rho mu (1 - mu^2) P_l' dmu,
//! ```
//!
//! the six-dimensional integral of Eq. (12) is a sum over `l` of integrals over `r > s`: each pair of radii once, so that
//! only the interior potential enters and no large powers cancel,
//!
//! ```text
//! 2 C = 4 pi^2 sum_l int dr r^(1-l) int_0^r ds s^(l+2) { [K_l - (l+1) J_l](r) M_l(s) + M_l(r) [l J_l + K_l](s) },
//! tr U = 4 pi^2 sum_l int dr r^(1-l) int_0^r ds s^(l+2) M_l(r) M_l(s).
//! ```
//!
//! Gauss-Legendre rules serve every integral. Between the largest sphere inside the star and the smallest one around it the
//! radius is that of the surface at a colatitude, which makes all integrands there as smooth as surface and density.
//!
//! Accuracy: the rules converge spectrally for smooth density and surface, the sum over degrees algebraically. Its tail is
//! `a (degree + 3/2)^-3` for a density that ends by a jump, and is removed by Richardson's extrapolation from half the
//! degree; what is left decreases as `degree^-5`. For a uniform spheroid of axis ratio 0.95, 0.6, 2 the relative error of C
//! at degree 16 is 4e-6, 6e-5, 2e-4, at degree 32 it is 2e-7, 2e-6, 5e-6. For the sphere degree 2 is exact.

use core::f64::consts::PI;
use core::num::NonZeroUsize;

use gauss_quad::GaussLegendre;

use crate::error::Error;
use crate::scalar::Real;
use crate::star::AxisymmetricTensor;
use crate::star::uniform_spheroid::UniformSpheroid;

/// An axisymmetric star that is its own mirror image in the equatorial plane, in spherical coordinates.
pub trait AxisymmetricBody<S> {
    /// Density at radius `r` and `mu = cos(theta)` in [0, 1], asked for inside the surface only.
    fn density(&self, r: S, mu: S) -> S;

    /// Radius `r_s` of the surface at `mu` in [0, 1] and its slope `d r_s / d mu`: a monotonic function of `mu`.
    fn surface(&self, mu: S) -> (S, S);
}

/// A pair of closures: the density and the surface.
impl<S, D: Fn(S, S) -> S, B: Fn(S) -> (S, S)> AxisymmetricBody<S> for (D, B) {
    fn density(&self, r: S, mu: S) -> S {
        self.0(r, mu)
    }

    fn surface(&self, mu: S) -> (S, S) {
        self.1(mu)
    }
}

impl<S: Real> AxisymmetricBody<S> for UniformSpheroid<S> {
    fn density(&self, _r: S, _mu: S) -> S {
        UniformSpheroid::density(self)
    }

    /// `r_s = a3 / sqrt(1 - e^2 (1 - mu^2))`.
    fn surface(&self, mu: S) -> (S, S) {
        let e2 = self.shape().eccentricity_squared();
        let inside = self.shape().axis_ratio_squared() + e2 * mu * mu;
        let radius = self.polar_radius() / inside.sqrt();
        (radius, -(radius * e2 * mu / inside))
    }
}

/// Integrals over an axisymmetric star, in units with G = 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisymmetricIntegrals<S> {
    /// Mass `M`.
    pub mass: S,
    /// Moments of inertia `I^xx = I^yy`, `I^zz`.
    pub moment_of_inertia: AxisymmetricTensor<S>,
    /// Tensor `U^xx = U^yy`, `U^zz` of Eqs. (15) and (17).
    pub potential_energy_tensor: AxisymmetricTensor<S>,
    /// Constant `C = (U^xx - U^zz) / 2`, Eq. (12), computed as such: no difference of large numbers.
    pub c: S,
    /// Estimated error of `c`: the part that the extrapolation in the degree has added. Larger than the error left.
    pub c_error: f64,
}

/// Nodes per integral beyond the highest degree.
const MORE_NODES: usize = 16;

/// Integrals of `body` from even Legendre degrees up to `degree`; derivatives pass through.
///
/// The work grows as `degree^4`: 0.01 ms at 4, 5 ms at 16, 40 ms at 32.
///
/// # Errors
/// [`Error::Domain`] for a degree that is not a positive multiple of 4, or a surface that is not positive and monotonic in
/// `mu`.
pub fn axisymmetric_integrals<S: Real>(
    body: &impl AxisymmetricBody<S>,
    degree: usize,
) -> Result<AxisymmetricIntegrals<S>, Error> {
    let allowed = "a positive multiple of 4: half of it is used for the extrapolation";
    Error::unless(degree > 0 && degree.is_multiple_of(4), "highest Legendre degree", degree as f64, allowed)?;
    let rule = unit_rule(NonZeroUsize::MIN.saturating_add(degree + MORE_NODES - 1));
    let (equator, pole) = (body.surface(S::zero()).0, body.surface(S::one()).0);
    let oblate = equator.re() >= pole.re();
    for &(mu, _) in &rule {
        let (radius, slope) = body.surface(S::from_f64(mu));
        Error::unless(radius.re() > 0.0, "radius of the surface r_s", radius.re(), "positive")?;
        let rise = if oblate { -slope.re() } else { slope.re() };
        // The slope of a sphere may be rounding.
        Error::unless(rise >= -1e-14 * radius.re(), "rise of r_s towards its larger end", rise, "not negative")?;
    }
    let star = Star { body, rule, terms: degree / 2 + 1, oblate };
    Ok(star.integrals(if oblate { pole } else { equator }))
}

/// Angular moments at one radius for one degree: `M_l`, `J_l`, `K_l`.
type Moments<S> = [S; 3];

struct Star<'a, S> {
    body: &'a dyn AxisymmetricBody<S>,
    /// Nodes and weights on [0, 1].
    rule: Vec<(f64, f64)>,
    /// Number of even degrees.
    terms: usize,
    oblate: bool,
}

impl<S: Real> Star<'_, S> {
    /// All integrals; `core` is the radius of the largest sphere inside the star.
    fn integrals(&self, core: S) -> AxisymmetricIntegrals<S> {
        let mut sum = Sum::new(self.terms);
        for &(t, w) in &self.rule {
            let r = core * t;
            sum.add(r, core * w, &self.moments(r, [S::zero(), S::one()]), &self.below_in_core(r));
        }
        let below_core = self.below_in_core(core);
        for &(mu, w) in &self.rule {
            let mu = S::from_f64(mu);
            let (r, slope) = self.body.surface(mu);
            let below = self.below_in_shell(mu, r, core, &below_core);
            sum.add(r, slope.abs() * w, &self.shell_moments(mu, r), &below);
        }
        sum.finish()
    }

    /// Moments at radius `r` over the directions `mu` between `from` and `to`, and their mirror images.
    fn moments(&self, r: S, [from, to]: [S; 2]) -> Vec<Moments<S>> {
        let mut moments = vec![[S::zero(); 3]; self.terms];
        for &(t, w) in &self.rule {
            let mu = from + (to - from) * t;
            let density = self.body.density(r, mu) * (to - from) * (2.0 * w);
            let p2 = (mu * mu * 3.0 - S::one()) * 0.5;
            // P_(l-1) and P_l; the former does not count at l = 0.
            let (mut previous, mut p) = (S::zero(), S::one());
            for (i, [m, j, k]) in moments.iter_mut().enumerate() {
                let l = 2.0 * i as f64;
                *m += density * p;
                *j += density * p * p2;
                *k += density * mu * (previous - mu * p) * (1.5 * l);
                let next = (mu * p * (2.0 * l + 1.0) - previous * l) / (l + 1.0);
                p = (mu * next * (2.0 * l + 3.0) - p * (l + 1.0)) / (l + 2.0);
                previous = next;
            }
        }
        moments
    }

    /// Moments on the sphere of radius `r = r_s(mu)`: over the directions in which the star reaches further.
    fn shell_moments(&self, mu: S, r: S) -> Vec<Moments<S>> {
        self.moments(r, if self.oblate { [S::zero(), mu] } else { [mu, S::one()] })
    }

    /// `r^(-l-3) int_0^r s^(l+2) {M_l, l J_l + K_l}(s) ds` in the core.
    fn below_in_core(&self, r: S) -> Vec<[S; 2]> {
        let mut below = vec![[S::zero(); 2]; self.terms];
        for &(t, w) in &self.rule {
            let moments = self.moments(r * t, [S::zero(), S::one()]);
            add_below(&mut below, S::from_f64(t), S::from_f64(w), &moments);
        }
        below
    }

    /// The same in the shell, at `r = r_s(mu)`: the core and the part of the shell below `r`.
    fn below_in_shell(&self, mu: S, r: S, core: S, below_core: &[[S; 2]]) -> Vec<[S; 2]> {
        let ratio = core / r;
        let mut power = ratio * ratio * ratio;
        let mut below = Vec::with_capacity(self.terms);
        for &[m, k] in below_core {
            below.push([m * power, k * power]);
            power *= ratio * ratio;
        }
        let end = if self.oblate { S::one() } else { S::zero() };
        for &(t, w) in &self.rule {
            let at = mu + (end - mu) * t;
            let (s, slope) = self.body.surface(at);
            let weight = slope.abs() * (end - mu).abs() * w / r;
            add_below(&mut below, s / r, weight, &self.shell_moments(at, s));
        }
        below
    }
}

/// Adds `weight ratio^(l+2) {M_l, l J_l + K_l}`.
fn add_below<S: Real>(below: &mut [[S; 2]], ratio: S, weight: S, moments: &[Moments<S>]) {
    let mut factor = weight * ratio * ratio;
    for (i, ([m_below, k_below], &[m, j, k])) in below.iter_mut().zip(moments).enumerate() {
        *m_below += factor * m;
        *k_below += factor * (j * (2.0 * i as f64) + k);
        factor *= ratio * ratio;
    }
}

/// Integrals over radius without their factors; those for `2 C` and for the trace by degree.
struct Sum<S> {
    mass: S,
    moment_xx: S,
    moment_zz: S,
    energies: Vec<[S; 2]>,
}

impl<S: Real> Sum<S> {
    fn new(terms: usize) -> Self {
        let zero = S::zero();
        Self { mass: zero, moment_xx: zero, moment_zz: zero, energies: vec![[zero; 2]; terms] }
    }

    fn add(&mut self, r: S, dr: S, moments: &[Moments<S>], below: &[[S; 2]]) {
        let [m0, j0, _] = moments[0];
        let (r2_dr, r4_dr) = (dr * r * r, dr * r * r * r * r);
        self.mass += r2_dr * m0;
        self.moment_xx += r4_dr * (m0 - j0) / 3.0;
        self.moment_zz += r4_dr * (m0 + j0 * 2.0) / 3.0;
        for (i, ([difference, trace], (&[m, j, k], &[m_below, k_below]))) in
            self.energies.iter_mut().zip(moments.iter().zip(below)).enumerate()
        {
            *difference += r4_dr * ((k - j * (2.0 * i as f64 + 1.0)) * m_below + m * k_below);
            *trace += r4_dr * m * m_below;
        }
    }

    fn finish(self) -> AxisymmetricIntegrals<S> {
        let half = self.energies.len() / 2 + 1;
        let degree = 2.0 * (self.energies.len() - 1) as f64;
        let growth = ((degree + 1.5) / (degree / 2.0 + 1.5)).powi(3) - 1.0;
        let sum = |of: &[[S; 2]], which: usize| of.iter().fold(S::zero(), |sum, term| sum + term[which]);
        let [difference, trace, tail] = {
            let tails = [0, 1].map(|which| sum(&self.energies[half..], which) / growth);
            let sums = [0, 1].map(|which| sum(&self.energies, which));
            [sums[0] + tails[0], sums[1] + tails[1], tails[0]].map(|x| x * (4.0 * PI * PI))
        };
        AxisymmetricIntegrals {
            mass: self.mass * (2.0 * PI),
            moment_of_inertia: AxisymmetricTensor {
                xx: (self.moment_xx + self.moment_zz) * (2.0 * PI),
                zz: self.moment_xx * (4.0 * PI),
            },
            potential_energy_tensor: AxisymmetricTensor {
                xx: (trace + difference) / 3.0,
                zz: (trace - difference * 2.0) / 3.0,
            },
            c: difference * 0.5,
            c_error: tail.re().abs() * 0.5,
        }
    }
}

/// Gauss-Legendre nodes and weights on [0, 1].
fn unit_rule(nodes: NonZeroUsize) -> Vec<(f64, f64)> {
    GaussLegendre::new(nodes).iter().map(|&(x, w)| (0.5 * (x + 1.0), 0.5 * w)).collect()
}
