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
    use nalgebra::Matrix3;

    use super::*;
    use crate::dynamics::RigidSpheroid;
    use crate::observables::pulsar::Beam;
    use crate::propagation::Motion;

    /// Thirty-two steps in each but the last; forwards in time alone.
    #[test]
    fn stretches_follow_one_another_to_the_end() {
        let spheroid = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 0.7, constant_c: 0.8 };
        let violation = Matrix3::from_diagonal(&Vector3::new(0.21, -0.1, -0.11));
        let axis = Vector3::new(0.6, 0.0, 0.8);
        let start = BodyState { axis, momentum: Vector3::new(0.5, -0.9, 1.7), equatorial_axis: Vector3::y() };
        let problem = Problem::new(spheroid, violation, start).unwrap();
        let (beam, n) = (Beam::new(0.7, 0.9, 0.2), Vector3::new(0.36, 0.48, 0.8));
        let follow = |span: (f64, f64), visit: &mut dyn FnMut(&SeriesProjection<'_>, f64)| {
            projected_by_segments(&problem, span, 1e-5, (&beam.axis, &n), |projection, end| {
                visit(projection, end);
                Ok(())
            })
            .unwrap()
        };
        assert!(follow((70.0, 2.0), &mut |_, _| panic!("backwards")).is_none());
        let span = (2.0, 70.0);
        let kept = problem.taylor(span, 1e-5).unwrap();
        let mut ends = Vec::new();
        let last = follow(span, &mut |projection, end| {
            for t in [end - 0.3, end] {
                let exact = n.dot(&beam.direction(&kept.state(t).unwrap()));
                assert!((projection.at(t).unwrap()[0] - exact).abs() < 1e-4, "{t}");
            }
            ends.push(end);
        });
        assert_eq!(last.is_some(), fused_for::<f64>().is_some());
        let Some(last) = last else { return };
        assert!(last.step_count > 64 && last.step_count == kept.step_count());
        assert_eq!(ends.len(), last.step_count.div_ceil(STEPS));
        assert!(span.0 < ends[0] && ends.is_sorted_by(|a, b| a < b) && ends[ends.len() - 1] == span.1, "{ends:?}");
        assert!((last.states[0].axis - kept.state(span.1).unwrap().axis).amax() < 1e-12);
    }
}
