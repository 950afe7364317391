//! How errors made on the way have grown by a later time.

/// Sums over the steps, at times `t_k`, from which the grown truncation `sum_k e_k u_k` and the grown rounding
/// `2e-16 sqrt(sum_k u_k^2)` follow, with `u_k = 1 + rate (t - t_k)`: rounding errors are independent, truncation errors not.
#[derive(Debug, Clone, Copy)]
pub(super) struct ErrorGrowth {
    truncation: f64,
    truncation_times: f64,
    steps: f64,
    times: f64,
    times_squared: f64,
}

impl ErrorGrowth {
    /// The initial state comes out of a few rounded operations, about two ulp of one.
    pub(super) fn of_rounded_start() -> Self {
        Self { truncation: 0.0, truncation_times: 0.0, steps: 4.0, times: 0.0, times_squared: 0.0 }
    }

    pub(super) fn add(&mut self, time: f64, truncation: f64) {
        self.truncation += truncation;
        self.truncation_times += truncation * time;
        self.steps += 1.0;
        self.times += time;
        self.times_squared += time * time;
    }

    pub(super) fn at(&self, time: f64, rate: f64) -> f64 {
        let now = 1.0 + rate * time;
        let truncation = self.truncation * now - rate * self.truncation_times;
        let squares = self.steps * now * now - 2.0 * rate * now * self.times + rate * rate * self.times_squared;
        truncation + f64::EPSILON * squares.max(1.0).sqrt()
    }
}
