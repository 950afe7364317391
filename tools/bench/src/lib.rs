//! Run time against error: the same scenes by every method, timed in turn, judged by references of 30 digits.
//!
//! A method is one line of [`METHODS`](method::METHODS). Times of different methods are comparable only within one run: they are
//! taken in turn, and what counts is their ratio.

pub mod growth;
pub mod method;
pub mod overhead;
mod runge_kutta;
pub mod scaling;
pub mod scene;
pub mod table;
pub mod timing;
pub mod work_precision;

/// How much is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Number of times that each case is run, in turn with the others.
    pub rounds: usize,
    /// Longest motion whose error growth is measured (t_c).
    pub longest: f64,
}

impl Effort {
    /// Some ten seconds.
    pub const QUICK: Self = Self { rounds: 3, longest: 1e4 };

    /// A few minutes.
    pub const FULL: Self = Self { rounds: 40, longest: 1e7 };
}
