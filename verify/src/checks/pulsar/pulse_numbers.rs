//! Pulse numbers across turns that have no pulse. Eqs. (44), (49), (50).

use super::cases::{Case, paper_signal, worst_over_random_cases};
use crate::prelude::*;

checks! {
    /// for tp-I and tp-II the numbers are the turns of the azimuth Phi about Z, by Eqs. (49), (50) and the continuous angles with DeltaPhi taken
    /// about -pi/2, turns without a pulse included; closest approaches stay within half a period of those of a constant one
    Oracle "arrival-numbers-about-z" [49, 50]: numbers_about_z;
    AtMost(0.0) "wrong numbers, and times off by half a period or more, up to 1,000 t_c";
    because "counts";
    /// pulses of a narrow beam, which misses turns, are numbered by the turns of m about L, counted in small steps from the line of sight, and a
    /// wider beam that contains it gives them the same numbers: tp-II, sp-I, sp-II and 300 random stars
    Property "arrival-numbers-of-missed-turns" [44]: numbers_of_missed_turns;
    AtMost(0.0) "pulses with another number than that of the turn or of the wider beam; infinite for fewer than 2,000 pulses of either comparison";
    because "counts";
}

fn numbers_about_z() -> Result<Measured, String> {
    let (mut wrong, mut details) = (0, Vec::new());
    for name in ["tp-1", "tp-2"] {
        let signal = paper_signal(name, 1000.0)?;
        let found = signal.arrivals()?;
        let start = signal.motion.state(0.0)?.angles()?;
        let mut angles = ContinuousAngles::new(&signal.motion, 0.0, &start)?;
        let mut first = None;
        for arrival in &found {
            let EulerAngles { alpha, beta, gamma } = angles.at(arrival.closest_approach)?;
            // For chi < beta the offset swings about -pi/2 and never makes a full turn; here beta falls below chi at times.
            let (x, y) = azimuth_offset_point(beta, gamma, 0.5, 0.0);
            let offset = x.atan2(-y) - FRAC_PI_2;
            let turn = ((alpha + offset) / TAU).round();
            let number = turn - *first.get_or_insert(turn);
            wrong += i32::from(number != arrival.number as f64);
        }
        let points: Vec<_> = found.iter().map(|a| (a.number, a.closest_approach)).collect();
        let fit = ConstantPeriod::fit(&points, None)?;
        wrong += fit.residuals.iter().map(|r| i32::from(r.abs() >= fit.period / 2.0)).sum::<i32>();
        let most = largest(fit.residuals.iter().map(|r| r.abs()));
        let turns = found.last().map_or(0, |a| a.number + 1);
        details.push(format!(
            "{name}: {} pulses in {turns} turns, P = {:.6}, residuals to {most:.3}",
            found.len(),
            fit.period
        ));
        if (name == "tp-2") != (turns > found.len() as i64) || found.len() < 150 {
            return Err(format!("{details:?}: tp-2 misses turns and tp-1 does not"));
        }
    }
    Ok(Measured::new(f64::from(wrong), details.join("; ")))
}

/// What was compared, and what was wrong.
#[derive(Default)]
struct Counts {
    wrong: usize,
    missed: i64,
    of_turns: usize,
    of_wider: usize,
}

impl Counts {
    /// Compares the numbers of a beam with turns and with those of a wider one.
    fn compare(&mut self, mut case: Case) -> Result<(), String> {
        let found = case.arrivals()?;
        self.compare_with_turns(&case, &found)?;
        case.beam.half_opening = (case.beam.half_opening * 1.5).min(1.5);
        let wider = case.arrivals()?;
        // The pulses are matched by the maximum of m.n. The wider beam may also have a pulse over several turns.
        let same = |arrival: &Arrival| {
            let same = |other: &&Arrival| (other.closest_approach - arrival.closest_approach).abs() < 1e-9;
            wider.iter().find(same).map(|other| arrival.number - other.number)
        };
        let differences: Vec<i64> = found.iter().filter_map(same).collect();
        self.of_wider += differences.len();
        self.wrong += differences.iter().filter(|difference| **difference != differences[0]).count();
        self.missed += found.last().map_or(0, |last| (last.number + 1 - found.len() as i64).max(0));
        Ok(())
    }

    /// Numbers are whole turns of the azimuth of m about L from the line of sight, summed over steps of a hundredth of a unit of time. Where m or the
    /// line of sight comes along L the azimuth jumps; such motions are left out.
    fn compare_with_turns(&mut self, case: &Case, found: &[Arrival]) -> Result<(), String> {
        let azimuth = |t: f64| -> Result<f64, Error> {
            let state = case.motion.state(t)?;
            let (l, m, o) = (state.momentum.normalize(), case.beam.direction(&state), case.observer);
            Ok(l.dot(&o.cross(&m)).atan2(o.dot(&m) - l.dot(&o) * l.dot(&m)))
        };
        let mut at = azimuth(0.0)?;
        let (mut time, mut unwrapped) = (0.0, at);
        let mut numbers = Vec::new();
        for arrival in found {
            while time < arrival.closest_approach {
                time = (time + 0.01).min(arrival.closest_approach);
                let next = azimuth(time)?;
                let step = wrapped(next - at);
                if step.abs() > 0.5 {
                    return Ok(());
                }
                (at, unwrapped) = (next, unwrapped + step);
            }
            numbers.push((unwrapped / TAU).round() as i64);
        }
        let Some((first, last)) = numbers.first().copied().zip(numbers.last().copied()) else { return Ok(()) };
        let sense = if last < first { -1 } else { 1 };
        let is_wrong =
            |(number, arrival): &(&i64, &Arrival)| sense * (**number - first) != arrival.number - found[0].number;
        self.wrong += numbers.iter().zip(found).filter(is_wrong).count();
        self.of_turns += numbers.len();
        Ok(())
    }
}

fn numbers_of_missed_turns() -> Result<Measured, String> {
    let mut counts = Counts::default();
    for name in ["tp-2", "sp-1", "sp-2"] {
        let motion = reference_motion(name).problem().taylor((0.0, 300.0), 1e-13)?;
        for theta_o in [0.4, 0.8, 1.2, 1.6] {
            let (beam, observer) = (Beam::new(0.5, 0.0, 0.4), Observer::at(theta_o, 0.0).direction);
            counts.compare(Case { name: name.to_owned(), motion: motion.clone(), beam, observer })?;
        }
    }
    worst_over_random_cases(84, 300, (60.0, 1e-10), |case| {
        let beam = Beam { half_opening: 0.3 * case.beam.half_opening, ..case.beam };
        counts.compare(Case { name: case.name.clone(), motion: case.motion.clone(), beam, ..*case })?;
        Ok(0.0)
    })?;
    let Counts { wrong, missed, of_turns, of_wider } = counts;
    if missed < 100 {
        return Err(format!("only {missed} turns were missed"));
    }
    let detail =
        format!("{wrong} wrong, {of_turns} compared with turns, {of_wider} with a wider beam, {missed} turns missed");
    Ok(Measured::new(if of_turns.min(of_wider) < 2000 { f64::INFINITY } else { wrong as f64 }, detail))
}
