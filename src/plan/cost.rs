//! Costs of the methods, fitted to measured times.

use super::{Method, State};

/// The machine on which the costs were measured. On another one they are all larger or smaller by about the same factor,
/// which does not change the choice.
pub const MACHINE: &str = "one core of an AMD EPYC, opt-level 2";

/// Costs of a method in ns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// Once.
    pub setup: f64,
    /// Of each step whose series has `order` terms: `step[0] + step[1] order + step[2] order^2`.
    pub step: [f64; 3],
    /// Of each evaluation: `evaluation[0] + evaluation[1] order`.
    pub evaluation: [f64; 2],
}

impl Cost {
    /// Costs of a method that carries `state`. From `cargo run -p twofold-verify --example fit_cost`.
    pub fn of(method: Method, state: State) -> Self {
        let closed = |setup, evaluation| Self { setup, step: [0.0; 3], evaluation: [evaluation, 0.0] };
        match (method, state) {
            (Method::Free, State::Orientation) => closed(50.0, 75.0),
            (Method::Free, _) => closed(50.0, 33.0),
            (Method::Steady, State::Orientation) => closed(400.0, 98.0),
            (Method::Steady, _) => closed(400.0, 57.0),
            (Method::Symmetric, _) => closed(4000.0, 615.0),
            (Method::Splitting, _) => Self { setup: 3000.0, step: [6.0, 12.0, 0.0], evaluation: [60.0, 18.0] },
            (Method::Taylor, State::Orientation) => {
                Self { setup: 0.0, step: [78.0, 22.0, 2.24], evaluation: [59.0, 3.04] }
            }
            (Method::Taylor, _) => Self { setup: 0.0, step: [82.0, 15.9, 1.67], evaluation: [49.0, 1.51] },
        }
    }

    /// Of a whole computation.
    pub fn total(&self, order: usize, steps: f64, evaluations: f64) -> f64 {
        let order = order as f64;
        let step = self.step[0] + order * (self.step[1] + order * self.step[2]);
        self.setup + steps * step + evaluations * (self.evaluation[0] + self.evaluation[1] * order)
    }
}
