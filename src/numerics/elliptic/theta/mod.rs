//! Jacobi's theta functions with their nome (DLMF 20.2, 20.7, 22.2), for motions that depend on one phase.
//!
//! Their series converge as `q^(n^2)`. For `q` near one those of Jacobi's imaginary transformation converge as `exp(pi^2 n^2 / ln q)`.
//! Four terms suffice for any parameter, and no sum of either kind cancels.
//!
//! Written here because no maintained Rust crate has them at complex arguments, without overflow.
//!
//! # Example
//!
//! ```
//! use twofold::numerics::elliptic::jacobi::{complete_integral, jacobi};
//! use twofold::numerics::elliptic::theta::{Nome, ThetaSeries};
//!
//! let (m, m1) = (0.3, 0.7_f64);
//! let nome = Nome::new(m, m1);
//! let series = ThetaSeries::new(nome.q, 0.5, nome.q / 0.5);
//! // At z = pi u / (2 K).
//! let z = 0.4_f64;
//! let at = series.at(z.sin(), z.cos());
//! let same = jacobi(z * complete_integral(m1) * core::f64::consts::FRAC_2_PI, m1);
//! assert!((at.sn - same.sn).abs() < 1e-15 && (at.dn - same.dn).abs() < 1e-15);
//! ```

mod nome_series;
mod transformed;

use core::f64::consts::PI;

use crate::numerics::scalar::Real;

use nome_series::NomeSeries;
use transformed::Transformed;

/// The nome above which the transformed series are used: there `theta_4(0)`, an alternating sum, is 0.4.
const TRANSFORMED: f64 = 0.3;

/// The nome `q = exp(-pi K'/K)` of a parameter `m`, with the ratio of `q` to `m`, which stays finite where both vanish.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nome<S> {
    /// `q`.
    pub q: S,
    /// `q / m`; `1/16` at `m = 0`.
    pub q_over_m: S,
    /// `pi K'/K = -ln q` for `q = 0.3` and above, where [`ThetaSeries::transformed`] is used: it keeps the digits that `q` loses by
    /// rounding.
    pub decay: Option<S>,
}

impl<S: Real> Nome<S> {
    /// The nome of the parameter `m` in `[0, 1)` and its complement `m1 = 1 - m > 0`, which the caller knows without
    /// cancellation.
    pub fn new(m: S, m1: S) -> Self {
        if m.re() <= 0.5 {
            let (over_m, series) = epsilon(m, m1);
            return Self { q: m * over_m * series, q_over_m: over_m * series, decay: None };
        }
        let (over_m1, series) = epsilon(m1, m);
        let decay = -(S::from_f64(PI * PI) / (m1 * over_m1 * series).ln());
        let q = (-decay).exp();
        Self { q, q_over_m: q / m, decay: Some(decay).filter(|_| q.re() >= TRANSFORMED) }
    }
}

/// `epsilon / m` with `epsilon = (1 - sqrt k') / (2 (1 + sqrt k'))`, and `q / epsilon = 1 + 2 epsilon^4 + ...` (DLMF 19.5.5), for `m <= 1/2`.
fn epsilon<S: Real>(m: S, m1: S) -> (S, S) {
    let complement = m1.sqrt();
    let root = complement.sqrt() + S::one();
    let over_m = S::one() / (root * root * (complement + S::one()) * 2.0);
    let e = m * over_m;
    let e4 = (e * e) * (e * e);
    let [two, fifteen, many] = [2.0, 15.0, 150.0].map(S::from_f64);
    (over_m, S::one() + e4 * (two + e4 * (fifteen + e4 * (many + e4 * 1707.0))))
}

/// The series of a nome, and of one imaginary shift of the argument.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThetaSeries<S>(Kind<S>);

#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "one of them at a time, and nothing on the heap")]
enum Kind<S> {
    Nome(NomeSeries<S>),
    Transformed(Transformed<S>),
}

/// Theta functions at one real argument, and quantities derived from them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AtPhase<S> {
    /// `sn(u)` for `z = pi u / (2 K)`.
    pub sn: S,
    /// `cn(u)`.
    pub cn: S,
    /// `dn(u)`.
    pub dn: S,
    /// `theta_4'(z) / theta_4(z)`: Jacobi's zeta function is `pi / (2 K)` times this.
    pub slope: S,
    /// A complex number (real and imaginary part) in the direction of `i theta_1(z + i eta)`.
    pub shifted: [S; 2],
}

impl<S: Real> ThetaSeries<S> {
    /// The series for the nome `q < 1`, and for `theta_1(z + i eta)` with `r = exp(-2 eta)` between `q` and one, given with
    /// `q / r`.
    pub fn new(q: S, r: S, q_over_r: S) -> Self {
        if q.re() < TRANSFORMED {
            return Self(Kind::Nome(NomeSeries::new(q, r, q_over_r)));
        }
        let decay = -q.ln();
        Self::transformed(decay, r.ln() * S::from_f64(-0.5 * PI) / decay)
    }

    /// For a nome given by its [decay](Nome::decay), and for `theta_1(z + i eta)` with `eta = decay * turned / pi`, `turned` between
    /// zero and `pi / 2`: accurate near `m = 1`, where `turned` is the argument in the complementary functions, and correct for any
    /// `q > 1e-3`.
    pub fn transformed(decay: S, turned: S) -> Self {
        Self(Kind::Transformed(Transformed::new(decay, turned)))
    }

    /// The functions at the argument whose sine and cosine are given.
    pub fn at(&self, sin: S, cos: S) -> AtPhase<S> {
        match &self.0 {
            Kind::Nome(series) => series.at(sin, cos),
            Kind::Transformed(series) => series.at(sin, cos),
        }
    }
}
