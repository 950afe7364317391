//! Long spans, whose turns cannot be followed one by one: plans that keep phases, and pulses near given epochs.

use super::Event;
use super::signal::turning_rate;
use crate::error::Error;
use crate::observables::pulsar::{ClockPulse, PulsarClock};
use crate::parameters::Parameters;
use crate::plan::{Method, Plan, Request};
use crate::propagation::PhasedMotion;

/// Rotation (rad) up to which every turn is followed.
const LARGEST_FOLLOWED: f64 = 1e5;

/// Largest error of directions (rad); derivatives of the averaged motion are then accurate to about as much.
const LARGEST_ERROR: f64 = 1e-3;

/// Maximum number of corrections to the time of a turn with a given number.
const MOST_CORRECTIONS: usize = 8;

/// Whether a span from the start to `end` is too long to be followed turn by turn: one of more than 1e5 rad of rotation.
pub fn is_long(parameters: &Parameters<f64>, end: f64) -> bool {
    end * turning_rate(parameters) > LARGEST_FOLLOWED
}

/// The plan for a request that begins at the start. Over a span too long to be followed turn by turn it uses a method that keeps phases; this is the
/// averaged motion if no other one meets the tolerance.
///
/// # Errors
/// As for [`Problem::plan`](crate::dynamics::Problem::plan), and [`Error::Domain`] for the error of the averaged motion.
pub(super) fn plan(parameters: &Parameters<f64>, request: Request) -> Result<Plan, Error> {
    let (problem, end) = (parameters.problem()?, request.span.1);
    let plan = problem.plan(&request);
    let meets = |plan: &Plan| plan.method.is_some_and(Method::keeps_phases);
    if !is_long(parameters, end) || plan.as_ref().is_ok_and(meets) {
        return plan;
    }
    ensure_exact(&PhasedMotion::averaged(&problem)?, end)?;
    problem.plan(&Request { method: Some(Method::Averaged), ..request })
}

/// Refuses a span to `end` whose pulses can be found neither turn by turn nor from a motion by phases.
///
/// # Errors
/// [`Error::Domain`] as for [`PhasedMotion::new`], and for an error of directions above 1e-3 rad.
pub fn check_span(parameters: &Parameters<f64>, end: f64) -> Result<(), Error> {
    if is_long(parameters, end) { motion(parameters, end).map(|_| ()) } else { Ok(()) }
}

fn motion(parameters: &Parameters<f64>, end: f64) -> Result<PhasedMotion, Error> {
    let motion = PhasedMotion::new(&parameters.problem()?, end)?;
    ensure_exact(&motion, end)?;
    Ok(motion)
}

fn ensure_exact(motion: &PhasedMotion, end: f64) -> Result<(), Error> {
    let error = motion.error_estimate(end);
    Error::ensure(
        error <= LARGEST_ERROR,
        "estimated error of directions (rad) over a span of more than 1e5 rad of rotation",
        error,
        "at most 1e-3; use a weaker violation or a shorter span",
    )
}

fn clock(parameters: &Parameters<f64>, end: f64) -> Result<PulsarClock, Error> {
    PulsarClock::new(motion(parameters, end)?, &parameters.beam(), &parameters.observer())
}

/// A pulse with its times counted from the double nearest to its midpoint. The closest approach is not computed.
fn event(pulse: &ClockPulse) -> Event {
    let ([epoch, rest], half) = (pulse.midpoint, pulse.duration / 2.0);
    Event { turn: pulse.number, epoch, start: rest - half, end: rest + half, closest: f64::NAN }
}

/// The pulse of the turn nearest to each of the given times up to `end`, in their order. A turn without a pulse gives none, each turn is used once,
/// and pulses before the start are left out.
///
/// # Errors
/// As for [`check_span`] and [`PulsarClock`].
pub(super) fn pulses_near(parameters: &Parameters<f64>, end: f64, times: &[f64]) -> Result<Vec<Event>, Error> {
    let clock = clock(parameters, end)?;
    let mut found: Vec<Event> = Vec::with_capacity(times.len());
    for &time in times {
        if let Some(pulse) = clock.pulse_near([time, 0.0])?
            && found.last().is_none_or(|last| last.turn < pulse.number)
            && pulse.midpoint[0] - pulse.duration / 2.0 > 0.0
        {
            found.push(event(&pulse));
        }
    }
    Ok(found)
}

/// The pulses of turns with given numbers. Each is searched for from an approximate time, taken from some other model; turns without a
/// pulse are left out.
///
/// # Errors
/// As for [`check_span`] and [`PulsarClock`].
pub(super) fn pulses_numbered(
    parameters: &Parameters<f64>,
    end: f64,
    turns: &[(i64, f64)],
) -> Result<Vec<Event>, Error> {
    if turns.is_empty() {
        return Ok(Vec::new());
    }
    let clock = clock(parameters, end)?;
    let period = clock.period();
    let mut found = Vec::with_capacity(turns.len());
    for &(number, near) in turns {
        let mut time = [near, 0.0];
        for _ in 0..MOST_CORRECTIONS {
            let Some(pulse) = clock.pulse_near(time)? else { break };
            if pulse.number == number {
                found.push(event(&pulse));
                break;
            }
            time = [pulse.midpoint[0] + (number - pulse.number) as f64 * period, 0.0];
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::euler_angles::{EulerAngles, EulerRates};
    use crate::inference::stars;
    use crate::lorentz_violation::PrincipalCoefficients;
    use crate::parameters::Parameter;
    use crate::plan::Output;

    #[test]
    fn spans_of_more_than_a_hundred_thousand_radians_are_long() {
        for (star, rate) in [(stars::slow(), 0.3), (stars::weak(), 1.3)] {
            let found = turning_rate(&star);
            assert!((0.8..2.0).contains(&(found / rate)), "{found}");
            assert!(!is_long(&star, 0.999e5 / found) && is_long(&star, 1.001e5 / found));
        }
    }

    /// A turn number is found from any starting time, even some turns away; turns take 4.8 and 0.3 units of time.
    #[test]
    fn pulses_are_found_by_their_numbers() {
        let weak = stars::weak();
        let fast = Parameters { alpha_rate: 15.0 * weak.alpha_rate, ..weak.moved(&[Parameter::Spin], &[18.7]) };
        for star in [weak, fast] {
            let end = 2e6;
            let period = clock(&star, end).expect("a clock").period();
            let near = pulses_near(&star, end, &[1e5, 1e6, 1.9e6]).expect("pulses");
            assert_eq!(near.len(), 3);
            for turns in [0.0, 0.4, -3.0, 7.0, 2_000.0] {
                let wanted: Vec<_> = near.iter().map(|event| (event.turn, event.epoch + turns * period)).collect();
                let found = pulses_numbered(&star, end, &wanted).expect("pulses");
                assert_eq!(found.len(), 3, "{period}: {turns}");
                for (event, before) in found.iter().zip(&near) {
                    assert_eq!(event.turn, before.turn);
                    let late = (event.epoch - before.epoch) + (event.midpoint() - before.midpoint());
                    assert!(late.abs() < 1e-9, "{period}: {turns}: {late:e}");
                }
            }
        }
        assert!(pulses_numbered(&weak, 2e6, &[]).expect("none asked for").is_empty());
    }

    #[test]
    fn the_pulse_of_the_turn_nearest_to_a_time_is_taken_once() {
        let (star, end) = (stars::weak(), 2e6);
        let period = clock(&star, end).expect("a clock").period();
        let at = |times: &[f64]| pulses_near(&star, end, times).expect("pulses");
        let first = at(&[1e6])[0];
        let middle = first.epoch + first.midpoint();
        for part in [-0.4, 0.0, 0.4] {
            assert_eq!(at(&[middle + part * period])[0].turn, first.turn, "{part}");
        }
        let turns: Vec<i64> = at(&[middle, middle + 0.1, middle + period, middle + 1.2 * period])
            .iter()
            .map(|event| event.turn)
            .collect();
        assert_eq!(turns, [first.turn, first.turn + 1]);
    }

    /// A star that spins about the middle axis of `s^IJ`, where its motion has no torus: the averaged motion is used where the violation is weak, and
    /// refused where it is not.
    #[test]
    fn where_there_is_no_torus_the_averaged_motion_stands_in() {
        let about_the_middle_axis = |s: f64| {
            let star = stars::weak();
            let angles = EulerAngles { alpha: std::f64::consts::PI, beta: std::f64::consts::FRAC_PI_2, gamma: 0.1 };
            let rates = EulerRates { alpha: 1e-9, beta: 0.0, gamma: 1.3 };
            let s = PrincipalCoefficients::new([2.0 * s, s, -4.0 * s]).tensor();
            Parameters::new(star.spheroid, s, angles, rates)
        };
        let request = |end: f64| Request::new(&[Output::PulseProfile], (0.0, end), 2, 1e-13);
        let weak = about_the_middle_axis(1e-8);
        assert!(weak.state().axis.y.abs() > 0.999);
        assert_eq!(plan(&weak, request(1e6)).expect("a plan").method, Some(Method::Averaged));
        assert_ne!(plan(&weak, request(1e3)).expect("a plan").method, Some(Method::Averaged));
        match plan(&about_the_middle_axis(3e-6), request(1e6)) {
            Err(Error::Domain { quantity, value, .. }) => {
                assert!(
                    quantity.starts_with("estimated error of directions") && (2e-3..0.9).contains(&value),
                    "{value}"
                );
            }
            other => panic!("{other:?}"),
        }
    }

    /// A pulse that has begun before the start does not count.
    #[test]
    fn pulses_begin_after_the_start() {
        let (star, end) = (stars::weak(), 2e6);
        let first = pulses_near(&star, end, &[5.0]).expect("pulses")[0];
        let width = first.end - first.start;
        let clock_rate = std::f64::consts::TAU / clock(&star, end).expect("a clock").period();
        for (middle, is_seen) in [(0.4, false), (0.6, true)] {
            // The observer is moved so that the pulse comes this fraction of its width after the start.
            let turn = -clock_rate * (first.epoch + first.midpoint() - middle * width);
            let moved = star.moved(&[Parameter::PhiO], &[turn]);
            let found = pulses_near(&moved, end, &[0.0]).expect("pulses");
            assert_eq!(found.len(), usize::from(is_seen), "{middle}: {found:?}");
        }
    }
}
