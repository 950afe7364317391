//! Pulse numbers across turns that have no pulse. Eqs. (44), (49), (50).

use super::cases::{Case, paper_signal, worst_over_random_cases};
use crate::prelude::*;

checks! {
    /// for tp-I and tp-II the numbers are the turns of the azimuth Phi about Z, by Eqs. (49), (50) and the continuous angles with DeltaPhi taken
    /// about -pi/2, turns without a pulse included; closest approaches stay within half a period of those of a constant one
    Oracle "arrival-numbers-about-z" [49, 50]: numbers_about_z;
    AtMost(0.0) "wrong numbers, and times off by half a period or more, up to 1,000 t_c";
    because "counts";
    /// a narrower beam, which misses turns, gives its pulses the same numbers as a wider beam that contains them: tp-II, sp-I, sp-II and 300
    /// random stars
    Property "arrival-numbers-of-missed-turns" [44]: numbers_of_missed_turns;
    AtMost(0.0) "pulses with another number";
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

/// Number of wrong pulse numbers of the beam compared with a wider one, and of turns that it missed. The wider beam stays in the case.
fn compare_beams(case: &mut Case) -> Result<(usize, i64), String> {
    let found = case.arrivals()?;
    case.beam.half_opening = (case.beam.half_opening * 1.5).min(1.5);
    let wider = case.arrivals()?;
    // The pulses are matched by the maximum of m.n. The wider beam may also have a pulse over several turns.
    let mut differences = found.iter().filter_map(|arrival| {
        let same = |other: &&Arrival| (other.closest_approach - arrival.closest_approach).abs() < 1e-9;
        wider.iter().find(same).map(|other| arrival.number - other.number)
    });
    let first = differences.next();
    let wrong = differences.filter(|difference| Some(*difference) != first).count();
    let turns = found.last().map_or(0, |last| last.number + 1);
    Ok((wrong, (turns - found.len() as i64).max(0)))
}

fn numbers_of_missed_turns() -> Result<Measured, String> {
    let (mut wrong, mut missed, mut compared) = (0, 0, 0);
    let mut see = |(w, m): (usize, i64)| {
        (wrong, missed, compared) = (wrong + w, missed + m, compared + 1);
    };
    for name in ["tp-2", "sp-1", "sp-2"] {
        let motion = reference_motion(name).problem().taylor((0.0, 300.0), 1e-13)?;
        for theta_o in [0.4, 0.8, 1.2, 1.6] {
            let (beam, observer) = (Beam::new(0.5, 0.0, 0.4), Observer::at(theta_o, 0.0).direction);
            see(compare_beams(&mut Case { name: name.to_owned(), motion: motion.clone(), beam, observer })?);
        }
    }
    worst_over_random_cases(84, 300, (60.0, 1e-10), |case| {
        let beam = Beam { half_opening: 0.3 * case.beam.half_opening, ..case.beam };
        see(compare_beams(&mut Case { name: case.name.clone(), motion: case.motion.clone(), beam, ..*case })?);
        Ok(0.0)
    })?;
    if missed < 100 {
        return Err(format!("only {missed} turns were missed"));
    }
    Ok(Measured::new(wrong as f64, format!("{compared} pairs of beams, {missed} turns missed")))
}
