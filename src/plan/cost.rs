//! Costs of the methods, fitted to measured times.

use super::{Method, State};

/// The machine on which the costs were measured. On another machine all costs change by about the same factor, which does
/// not affect the choice.
pub const MACHINE: &str = "one core of an AMD EPYC, opt-level 2";

/// Costs of a method in ns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// Set-up cost.
    pub setup: f64,
    /// Cost of each step whose series has `order` terms: `step[0] + step[1] order + step[2] order^2`.
    pub step: [f64; 3],
    /// Cost of each evaluation: `evaluation[0] + evaluation[1] order`.
    pub evaluation: [f64; 2],
}

/// Cost of derivatives on the torus with respect to one parameter: set-up, and for each state.
const TORUS_DERIVATIVE: [f64; 2] = [100_000.0, 20_000.0];

impl Cost {
    /// Costs of a method that carries `state`, from `cargo run --release -p twofold-tools --bin fit_cost`.
    pub fn of(method: Method, state: State) -> Self {
        let closed = |setup, evaluation| Self { setup, step: [0.0; 3], evaluation: [evaluation, 0.0] };
        match (method, state) {
            (Method::Free, State::Orientation) => closed(60.0, 111.0),
            (Method::Free, _) => closed(60.0, 53.0),
            (Method::Steady, State::Orientation) => closed(400.0, 133.0),
            (Method::Steady, _) => closed(400.0, 75.0),
            (Method::Symmetric, _) => closed(3900.0, 622.0),
            (Method::Averaged, _) => closed(2500.0, 260.0),
            (Method::Torus, State::Orientation) => closed(610_000.0, 163.0),
            (Method::Torus, _) => closed(610_000.0, 90.0),
            (Method::Splitting, State::Orientation) => {
                Self { setup: 2500.0, step: [6.0, 10.5, 0.0], evaluation: [240.0, 6.0] }
            }
            (Method::Splitting, _) => Self { setup: 2500.0, step: [6.0, 9.2, 0.0], evaluation: [187.0, 4.6] },
            (Method::Taylor, State::Orientation) => {
                Self { setup: 2500.0, step: [39.0, 12.8, 0.61], evaluation: [47.0, 1.31] }
            }
            (Method::Taylor, _) => Self { setup: 2500.0, step: [-13.0, 18.0, 0.21], evaluation: [22.0, 0.49] },
        }
    }

    /// Costs of a method that carries `state` and its derivatives with respect to `count` parameters.
    ///
    /// By splitting, a state with tangent maps takes 1.4 times the work of a state alone, and each register of four directions takes 0.6 times that.
    /// A dual number takes ten times the work of a series in vector registers and three times that of a closed form, once for each parameter. On the
    /// torus it follows both closed orbits once, and a part of them again for each state.
    pub(super) fn with_derivatives(method: Method, state: State, count: usize) -> Self {
        let Self { setup, step, evaluation } = Self::of(method, state);
        let factor = match (method, count) {
            (_, 0) => 1.0,
            (Method::Torus, _) => {
                let [setup_of_each, flow] = TORUS_DERIVATIVE.map(|cost| cost * count as f64);
                return Self { setup: setup + setup_of_each, step, evaluation: [evaluation[0] + flow, 0.0] };
            }
            (Method::Splitting, _) => 1.4 * method.motions_for(count) as f64 + 0.6 * count.div_ceil(4) as f64,
            (Method::Taylor, _) => 10.0 * count as f64,
            _ => 3.0 * count as f64,
        };
        let times = |cost: f64| factor * cost;
        Self { setup: times(setup), step: step.map(times), evaluation: evaluation.map(times) }
    }

    /// Total cost of a computation.
    pub fn total(&self, order: usize, steps: f64, evaluations: f64) -> f64 {
        let order = order as f64;
        let step = self.step[0] + order * (self.step[1] + order * self.step[2]);
        self.setup + steps * step + evaluations * (self.evaluation[0] + self.evaluation[1] * order)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Splitting with five parameters carries one motion with two registers of tangents; with twenty, two motions with five
    /// registers.
    #[test]
    fn derivatives_cost_so_many_times_what_a_state_costs() {
        let factors = [
            (Method::Averaged, 5, 15.0),
            (Method::Taylor, 5, 50.0),
            (Method::Splitting, 5, 2.6),
            (Method::Splitting, 20, 5.8),
        ];
        for (method, count, factor) in factors {
            for state in [State::Axis, State::Orientation] {
                let (alone, found) = (Cost::of(method, state), Cost::with_derivatives(method, state, count));
                let ratios = [
                    found.setup / alone.setup,
                    found.step[1] / alone.step[1],
                    found.evaluation[0] / alone.evaluation[0],
                    found.evaluation[1] / alone.evaluation[1],
                ];
                // A closed form has no steps.
                let off = ratios.into_iter().filter(|ratio| !ratio.is_nan()).map(|ratio| (ratio / factor - 1.0).abs());
                assert!(off.fold(0.0, f64::max) < 1e-15, "{method:?} {count}: {ratios:?}");
            }
        }
        for method in Method::ALL {
            assert_eq!(Cost::with_derivatives(method, State::Axis, 0), Cost::of(method, State::Axis));
        }
    }

    /// On the torus each parameter adds 0.1 ms once and 20 us for each state.
    #[test]
    fn derivatives_on_the_torus_cost_something_beside_the_state() {
        let found = Cost::with_derivatives(Method::Torus, State::Axis, 3);
        assert_eq!(found, Cost { setup: 910_000.0, step: [0.0; 3], evaluation: [60_090.0, 0.0] });
        assert_eq!(found.total(0, 0.0, 10.0), 1_510_900.0);
    }
}
