//! Sums that keep what each addition loses.

use nalgebra::Vector3;

use crate::dynamics::BodyState;
use crate::rounding::two_sum;
use crate::scalar::Scalar;

/// A time as an unevaluated sum, so that many small steps do not add up their rounding.
#[derive(Debug, Clone, Copy)]
pub(super) struct Compensated {
    pub(super) high: f64,
    pub(super) low: f64,
}

impl Compensated {
    pub(super) fn new(high: f64) -> Self {
        Self { high, low: 0.0 }
    }

    pub(super) fn add(&mut self, step: f64) {
        let (high, low) = two_sum(self.high, step + self.low);
        (self.high, self.low) = (high, low);
    }
}

/// A state whose additions are compensated: `high` is the state, `low` what its last addition lost.
pub(super) struct CompensatedState<S> {
    pub(super) high: BodyState<S>,
    pub(super) low: BodyState<S>,
}

impl<S: Scalar> CompensatedState<S> {
    pub(super) fn new(state: &BodyState<S>) -> Self {
        let zero = Vector3::zeros();
        Self { high: *state, low: BodyState { axis: zero, momentum: zero, equatorial_axis: zero } }
    }

    pub(super) fn add(&mut self, change: &BodyState<S>) {
        let add = |high: &mut Vector3<S>, low: &mut Vector3<S>, change: &Vector3<S>| {
            for i in 0..3 {
                (high[i], low[i]) = two_sum(high[i], change[i] + low[i]);
            }
        };
        add(&mut self.high.axis, &mut self.low.axis, &change.axis);
        add(&mut self.high.momentum, &mut self.low.momentum, &change.momentum);
        add(&mut self.high.equatorial_axis, &mut self.low.equatorial_axis, &change.equatorial_axis);
    }
}
