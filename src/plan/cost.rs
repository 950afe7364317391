//! Costs of the methods, fitted to measured times.

use super::{Method, State};

/// The machine on which the costs were measured. On another one they are all larger or smaller by about the same factor,
/// which does not change the choice.
pub const MACHINE: &str = "AMD EPYC (Zen), one core, rustc 1.89, release";

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
    /// Costs of a method that carries `state`. From `cargo run --release -p twofold-verify --example fit_cost`.
    pub fn of(method: Method, state: State) -> Self {
        let closed = |setup, evaluation| Self { setup, step: [0.0; 3], evaluation: [evaluation, 0.0] };
        match (method, state) {
            (Method::Free | Method::Steady, State::Orientation) => closed(100.0, 75.0),
            (Method::Free | Method::Steady, _) => closed(100.0, 40.0),
            (Method::Symmetric, _) => closed(6000.0, 3000.0),
            (Method::Taylor, State::Orientation) => {
                Self { setup: 300.0, step: [100.0, 20.0, 3.0], evaluation: [30.0, 4.0] }
            }
            (Method::Taylor, _) => Self { setup: 300.0, step: [100.0, 15.0, 2.0], evaluation: [30.0, 2.7] },
        }
    }

    /// Of a whole computation.
    pub fn total(&self, order: usize, steps: f64, evaluations: f64) -> f64 {
        let order = order as f64;
        let step = self.step[0] + order * (self.step[1] + order * self.step[2]);
        self.setup + steps * step + evaluations * (self.evaluation[0] + self.evaluation[1] * order)
    }
}
