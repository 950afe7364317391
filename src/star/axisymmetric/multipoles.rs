//! Sums and integrals of the multipole expansion.

use core::f64::consts::PI;

use crate::numerics::scalar::Real;
use crate::star::AxisymmetricTensor;
use crate::star::axisymmetric::{AxisymmetricBody, AxisymmetricIntegrals};

/// Angular moments at one radius for one degree: `M_l`, `J_l`, `K_l`.
type Moments<S> = [S; 3];

/// A star and the quadrature rule with which it is resolved.
pub(super) struct Multipoles<'a, S> {
    pub(super) body: &'a dyn AxisymmetricBody<S>,
    /// Nodes and weights on [0, 1].
    pub(super) rule: Vec<(f64, f64)>,
    /// Number of even degrees.
    pub(super) terms: usize,
    /// Whether the surface is farthest from the centre at the equator.
    pub(super) oblate: bool,
}

impl<S: Real> Multipoles<'_, S> {
    /// All integrals; `core` is the radius of the largest sphere inside the star.
    pub(super) fn integrals(&self, core: S) -> AxisymmetricIntegrals<S> {
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
            // P_(l-1) and P_l; the former is irrelevant at l = 0.
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

    /// Moments on the sphere of radius `r = r_s(mu)`: over the directions in which the star extends farther.
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

    /// As `below_in_core`, in the shell at `r = r_s(mu)`: from the core and the part of the shell below `r`.
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

/// Integrals over radius without their prefactors; those for `2 C` and for the trace are kept for each degree.
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
