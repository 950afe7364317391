//! The largest allowed difference of each column, with its reason.

use super::known::KnownFile;
use super::recompute::Scales;

#[derive(Debug, Clone, Copy)]
pub(super) struct Allowed {
    /// Largest allowed difference; `None` if the column cannot be judged.
    pub(super) limit: Option<f64>,
    pub(super) reason: &'static str,
}

impl Allowed {
    /// For a series compared with one that starts elsewhere.
    pub(super) const OTHER_START: Self = Self {
        limit: None,
        reason: "for information: the file was made from the caption's rounded initial values, not from Eq. (34)",
    };

    const UNKNOWN: Self = Self { limit: None, reason: "no error of the file itself is known to judge it by" };
}

pub(super) fn allowed(known: &KnownFile, column: &str, scales: Option<&Scales>) -> Allowed {
    let own = |column: &str| own_error(known, column);
    let up_to = |limit, reason| Allowed { limit: Some(limit), reason };
    if let Some(limit) = own(column) {
        return up_to(limit, "the file's own error against 34-digit reference motions, to its last digit");
    }
    let Some(scales) = scales else { return Allowed::UNKNOWN };
    if column.ends_with("Eq. (33)") {
        let limit = ROUNDINGS * scales.phase * f64::EPSILON / 2.0;
        return up_to(limit, "Eq. (33) as printed in doubles: 8 roundings of 1.1e-16 of its largest phase");
    }
    let (Some(alpha), Some(beta)) = (own("alpha"), own("beta")) else { return Allowed::UNKNOWN };
    let &Scales { duration, sin_beta, cos_beta, alpha_rate, beta_rate, .. } = scales;
    match column {
        "e_z X" | "e_z Y" => {
            let reason = "from the errors of the file's alpha and beta: sin(beta) |d alpha| + |d beta|";
            up_to(sin_beta * alpha + beta, reason)
        }
        "e_z Z" => up_to(sin_beta * beta, "from the error of the file's beta: sin(beta) |d beta|"),
        _ => up_to(
            alpha + beta + cos_beta * alpha + duration * sin_beta * (beta_rate * alpha + alpha_rate * beta),
            "from the errors of the file's alpha and beta: |d alpha| + |d beta| + |d gamma|, with the largest d gamma \
             that gamma' = Omega^z - alpha' cos(beta) allows",
        ),
    }
}

/// The allowed difference of the stamps or values of a pulse series: the error of `m.n` over its slowest rate at an edge.
pub(super) fn allowed_of_series(known: &KnownFile, column: &str, slowest_rate: f64) -> Allowed {
    let Some(edge) = own_error(known, "m.n").map(|error| error / slowest_rate) else { return Allowed::UNKNOWN };
    if column == "stamp" {
        return Allowed {
            limit: Some(edge),
            reason: "from the error of the same solver's m.n: |d m.n| over the slowest rate of m.n at an edge of a pulse",
        };
    }
    Allowed { limit: Some(2.0 * edge), reason: "twice that of a stamp: a difference of two times" }
}

fn own_error(known: &KnownFile, quantity: &str) -> Option<f64> {
    known.own_errors.iter().find(|(name, _)| *name == quantity).map(|(_, error)| up_to_last_digit(*error))
}

/// Roundings in two evaluations of a phase of Eq. (33): four in each, for the rate, its product with time and the sum.
const ROUNDINGS: f64 = 8.0;

/// The largest number that rounds to `error` with two digits.
fn up_to_last_digit(error: f64) -> f64 {
    error + 10f64.powi(error.log10().floor() as i32 - 1) / 2.0
}
