//! The projection of a direction in the body, segment by segment, without storing the motion.

use nalgebra::Vector3;

use crate::dynamics::{BodyState, Problem};
use crate::error::Error;
use crate::numerics::fused::run_fused;
use crate::propagation::taylor::projection::SeriesProjection;
use crate::propagation::taylor::samples::{LIMIT, Samples};
use crate::propagation::taylor::scaled_problem::ScaledProblem;
use crate::propagation::taylor::{Steps, fused_for, work_of};

/// Number of steps of one segment: few enough that their series stay in the cache.
const STEPS: usize = 32;

/// Receives the steps of a segment and the time at which it ends.
type Visit<'a> = dyn FnMut(&Steps<f64, 3>, f64) -> Result<(), Error> + 'a;

/// Follows the numerical motion over a span forwards in time, and gives `visit` the projection on `direction` of the vector
/// `in_body` over one segment after another, with the time at which the segment ends. Returns the state at the end of the
/// span.
///
/// `None` if the series has no projection: on a processor without vector instructions, and backwards in time.
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
    // Not inlined, because the work on a segment would take registers from the series.
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
    Ok(Some(Samples { states: vec![end], step_count, order: setup.order }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::fixture::problem;
    use crate::propagation::Motion;

    /// Every segment has exactly 32 steps, and continues where the last one ended; together they are the steps of the stored motion.
    #[test]
    fn stretches_are_the_steps_of_the_motion() {
        let (problem, span) = (problem([0.02, 0.01, -0.03]), (2.0, 1000.0));
        let motion = problem.taylor(span, 1e-8).unwrap();
        let both = (&Vector3::x(), &Vector3::y());
        let mut ends = vec![span.0];
        let end = projected_by_segments(&problem, span, 1e-8, both, |projection, end| {
            let first = *ends.last().expect("the start");
            // No series of an earlier segment is stored.
            let earlier = projection.cheapest_time(f64::NEG_INFINITY, first - 1e-9);
            assert!(earlier.is_none() && first < end, "{first} {end} {earlier:?}");
            let kept = motion.projection(both.0, both.1).expect("for doubles");
            assert_eq!(projection.at((first + end) / 2.0)?, kept.at((first + end) / 2.0)?);
            ends.push(end);
            Ok(())
        });
        let Some(end) = end.unwrap() else { return };
        assert_eq!((end.step_count, end.order), (motion.step_count, motion.order));
        assert_eq!(ends.len() - 1, motion.step_count.div_ceil(STEPS));
        assert!(ends.len() > 4 && ends[ends.len() - 1] == span.1, "{ends:?}");
    }

    #[test]
    fn a_motion_backwards_in_time_is_not_followed() {
        let problem = problem([0.0; 3]);
        let both = (&Vector3::x(), &Vector3::y());
        let followed = projected_by_segments(&problem, (70.0, 2.0), 1e-5, both, |_, _| panic!("backwards"));
        assert!(followed.unwrap().is_none());
    }
}
