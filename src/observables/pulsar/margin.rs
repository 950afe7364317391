//! The margin `m.n - cos rho` along a motion; it is positive where the line of sight is inside the beam.

use nalgebra::Vector3;

use super::Beam;
use crate::dynamics::BodyState;
use crate::error::Error;
use crate::propagation::{Motion, SeriesProjection, Turning};

/// The margin `m.n - cos rho` along a motion.
pub(super) trait Margin {
    /// The margin with its first three time derivatives at the time `t`.
    fn at(&self, t: f64) -> Result<[f64; 4], Error>;

    /// The latest time in `(after, t]` at which the margin is cheaper to evaluate than at `t`; `t` if there is none.
    fn cheapest_time(&self, after: f64, t: f64) -> f64;

    /// Whether the derivatives come from a law stated by the motion, so that the values may be inconsistent with them.
    const BY_STATED_LAW: bool = false;

    /// Possible error of the values at the time `t`.
    fn estimated_error(&self, _t: f64) -> f64 {
        0.0
    }
}

/// The margin from the series of a motion, which are cheapest to evaluate at their start.
pub(super) struct BySeries<'a> {
    projection: &'a SeriesProjection<'a>,
    /// `cos rho`.
    edge: f64,
}

impl<'a> BySeries<'a> {
    /// `projection` is that of the beam axis on the line of sight.
    pub(super) fn new(projection: &'a SeriesProjection<'a>, beam: &Beam<f64>) -> Self {
        Self { projection, edge: beam.half_opening.cos() }
    }
}

impl Margin for BySeries<'_> {
    fn at(&self, t: f64) -> Result<[f64; 4], Error> {
        let [product, rate, second, third] = self.projection.at(t)?;
        Ok([product - self.edge, rate, second, third])
    }

    fn cheapest_time(&self, after: f64, t: f64) -> f64 {
        self.projection.cheapest_time(after, t).unwrap_or(t)
    }
}

/// The margin from the states of any motion.
pub(super) struct ByStates<'a, M> {
    pub(super) motion: &'a M,
    pub(super) turning: Turning<'a>,
    pub(super) beam: &'a Beam<f64>,
    pub(super) line_of_sight: &'a Vector3<f64>,
}

impl<M: Motion<f64, State = BodyState<f64>>> Margin for ByStates<'_, M> {
    fn at(&self, t: f64) -> Result<[f64; 4], Error> {
        let (state, motion) = (self.motion.state(t)?, self.motion);
        match &self.turning {
            Turning::Equations { bulge } => {
                let (spheroid, s) = (motion.spheroid(), motion.coefficients());
                Ok(self.beam.margin_rates(spheroid, s, *bulge, &state, self.line_of_sight))
            }
            Turning::Given { rates, bounds } => {
                let rates = rates(t)?;
                for (rate, bound) in rates.iter().zip(bounds) {
                    let size = rate.norm();
                    let allowed = "at most the bound that the motion states for it";
                    Error::ensure(size <= bound * (1.0 + 1e-9), "size of Omega or a derivative of it", size, allowed)?;
                }
                Ok(self.beam.margin_rates_turning(&rates, &state, self.line_of_sight))
            }
        }
    }

    fn cheapest_time(&self, _: f64, t: f64) -> f64 {
        t
    }

    const BY_STATED_LAW: bool = true;

    fn estimated_error(&self, t: f64) -> f64 {
        self.motion.error_estimate(t)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use core::cell::Cell;

    use super::*;
    use crate::dynamics::fixture::problem;
    use crate::observables::pulsar::edge_search::EdgeSearch;
    use crate::observables::pulsar::rate_bounds::RateBounds;
    use crate::propagation::UniformMotion;

    /// A rate may exceed its stated bound by rounding, a billionth.
    #[test]
    fn rates_keep_to_the_bounds_that_are_stated() {
        let motion = UniformMotion::free(&problem([0.0; 3]), (0.0, 1.0));
        let (beam, line_of_sight) = (Beam::new(0.5, 0.0, 0.3), Vector3::x());
        for place in 0..3 {
            let looked = |excess: f64| {
                let rate = |k: usize| Vector3::z() * if k == place { 1.0 + excess } else { 0.5 };
                let turning = Turning::Given { rates: Box::new(move |_| Ok([0, 1, 2].map(rate))), bounds: [1.0; 6] };
                ByStates { motion: &motion, turning, beam: &beam, line_of_sight: &line_of_sight }.at(0.3)
            };
            assert!(looked(0.9e-9).is_ok() && looked(1.1e-9).is_err(), "{place}");
        }
    }

    /// A margin given by a function, with a count of its evaluations.
    pub(in crate::observables::pulsar) struct Given<F>(F, pub(in crate::observables::pulsar) Cell<usize>);

    impl<F: Fn(f64) -> [f64; 4]> Margin for Given<F> {
        fn at(&self, t: f64) -> Result<[f64; 4], Error> {
            self.1.set(self.1.get() + 1);
            // A search takes some dozens of evaluations.
            Error::ensure(self.1.get() < 10_000, "looks", 1e4, "fewer")?;
            Ok((self.0)(t))
        }

        fn cheapest_time(&self, _: f64, t: f64) -> f64 {
            t
        }
    }

    /// A search for a function with bounds on its derivatives.
    pub(in crate::observables::pulsar) fn search<F: Fn(f64) -> [f64; 4]>(
        bounds: RateBounds,
        margin: F,
    ) -> EdgeSearch<Given<F>> {
        EdgeSearch::new(Given(margin, Cell::new(0)), bounds)
    }

    /// `sum a cos(w t + p) - edge` with three derivatives.
    pub(in crate::observables::pulsar) fn waves(waves: Vec<[f64; 3]>, edge: f64) -> impl Fn(f64) -> [f64; 4] {
        move |t| {
            waves.iter().fold([-edge, 0.0, 0.0, 0.0], |found, [a, w, p]| {
                let (sin, cos) = (w * t + p).sin_cos();
                let terms = [cos, -w * sin, -w * w * cos, w * w * w * sin];
                core::array::from_fn(|k| found[k] + a * terms[k])
            })
        }
    }

    /// A search for `waves`, with the bounds that follow from the amplitudes and frequencies.
    pub(in crate::observables::pulsar) fn search_of(
        of: Vec<[f64; 3]>,
        edge: f64,
    ) -> EdgeSearch<Given<impl Fn(f64) -> [f64; 4]>> {
        let bound = |order: i32| of.iter().map(|[a, w, _]| a.abs() * w.powi(order)).sum::<f64>();
        let [first, second, third, fourth, sixth] = [1, 2, 3, 4, 6].map(bound);
        search(RateBounds { first, second, third, fourth, sixth }, waves(of, edge))
    }
}
