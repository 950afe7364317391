//! The projection of a direction in the body, stretch by stretch, without keeping the motion.

use nalgebra::Vector3;

use crate::dynamics::{BodyState, Problem};
use crate::error::Error;
use crate::numerics::fused::run_fused;
use crate::propagation::taylor::projection::SeriesProjection;
use crate::propagation::taylor::samples::{LIMIT, Samples};
use crate::propagation::taylor::scaled_problem::ScaledProblem;
use crate::propagation::taylor::{Steps, fused_for, work_of};

/// Steps of one stretch: few enough that their series stay in the fast memory in which they were made.
const STEPS: usize = 32;

/// Takes the steps of a stretch and the time at which it ends.
type Visit<'a> = dyn FnMut(&Steps<f64, 3>, f64) -> Result<(), Error> + 'a;

/// Follows the numerical motion over a span forwards in time, and gives `visit` the projection on `direction` of the
/// vector `in_body` over one stretch after another, with the time at which it ends. Returns the state at the end of the span.
///
/// `None` where the series has no projection: on a processor without vector instructions, and backwards in time.
pub(crate) fn projected_by_segments(
    problem: &Problem<f64>,
    span: (f64, f64),
    tolerance: f64,
    (in_body, direction): (&Vector3<f64>, &Vector3<f64>),
    mut visit: impl FnMut(&SeriesProjection<'_>, f64) -> Result<(), Error>,
) -> Result<Option<Samples<BodyState<f64>>>, Error> {
    let Some(fused) = fused_for::<f64>().filter(|_| span.0 <= span.1) else { return Ok(None) };
    let setup = ScaledProblem::new(work_of(Some(fused)), problem, span, tolerance)?;
    let mut kept = Steps::with_places(STEPS, setup.order);
    let mut step_count = 0;
    // Not inlined: what is done with a stretch would take registers from the series.
    let visit: &mut Visit =
        &mut |steps, end| visit(&SeriesProjection::new(&setup, steps, fused, in_body, direction), end);
    run_fused(
        fused,
        #[inline(always)]
        || {
            setup.drive().run(fused, LIMIT, |step, series| {
                step_count += 1;
                if kept.count() == STEPS {
                    visit(&kept, span.0 + step.start.high)?;
                    kept.clear();
                }
                kept.keep(fused, step.start, series);
                Ok(())
            })
        },
    )?;
    visit(&kept, span.1)?;
    let vectors = run_fused(
        fused,
        #[inline(always)]
        || kept.sum(&setup, fused, kept.count() - 1, span.1),
    );
    let end = setup.body_state(vectors.map(|v| v.vector()), span.1);
    Ok(Some(Samples { states: vec![end], error_estimates: Vec::new(), step_count, order: setup.order }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motion_backwards_in_time_is_not_followed() {
        let problem = crate::dynamics::fixture::problem([0.0; 3]);
        let both = (&Vector3::x(), &Vector3::y());
        let followed = projected_by_segments(&problem, (70.0, 2.0), 1e-5, both, |_, _| panic!("backwards"));
        assert!(followed.unwrap().is_none());
    }
}
