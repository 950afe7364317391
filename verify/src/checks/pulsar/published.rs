//! The authors' published series of tp-I. Eqs. (44), (47).

use super::cases::signal_of;
use crate::prelude::*;

checks! {
    /// m.n at t = 0, and widths and periods of tp-I from the initial values rounded as in the caption, are the authors' published data for tp-I:
    /// chi = 0.5, delta = 0, theta_o = 0.8, phi_o = 0, rho = 0.6
    Oracle "pulse-train-authors" [44, 47]: against_authors;
    AtMost(1e-5) "largest difference of a time stamp, width or period [t_c]";
    because "their solver ran at its default tolerance: m.n is off by up to 2.7e-6, at a slope of about 0.3 per t_c";
}

fn against_authors() -> Result<Measured, String> {
    // The authors' published data for tp-I: the first m.n; stamp and width, the first three and the last; stamp and period.
    let product = 0.8732849142282997;
    let widths = [
        (3.828609023865643, 0.9605118289805623),
        (8.205511113572069, 0.7806907650310357),
        (12.602135308459124, 0.7975891797573453),
        (398.3469555298456, 1.1398424518724823),
    ];
    let periods = [
        (6.017060068718855, 4.376902089706426),
        (10.403823211015595, 4.396624194887055),
        (14.787566950834744, 4.370863284751239),
    ];
    // Their m.n starts from Eq. (34); their two series from the caption's values of beta and alpha', rounded to 0.001.
    let reference = reference_motion("tp-1");
    let angles = EulerAngles { beta: 0.701, ..reference.angles };
    let rates = EulerRates { alpha: 1.509, beta: 0.0, gamma: reference.spin - 1.509 * angles.beta.cos() };
    let rounded = Problem::from_angles(reference.spheroid, reference.violation(), &angles, &rates)?;
    let signal = signal_of("tp-1", &reference.problem(), 400.0)?;
    let at_start = signal.beam.direction(reference.problem().initial()).dot(&signal.observer);
    let (exact, rounded) = (signal.train()?, signal_of("tp-1, rounded", &rounded, 400.0)?.train()?);
    let (durations, found): (Vec<_>, Vec<_>) = (rounded.durations().collect(), rounded.periods().collect());
    // They list 96 widths and 95 periods up to 400 t_c.
    if (durations.len(), found.len(), rounded.grazings.len()) != (96, 95, 0) {
        return Err(format!("{} whole pulses, {} periods", durations.len(), found.len()));
    }
    let mut worst = Worst::default();
    worst.see((at_start - product).abs(), || "m.n at t = 0".into());
    let ours = [durations[0], durations[1], durations[2], durations[95], found[0], found[1], found[2]];
    for ((time, value), ours) in widths.into_iter().chain(periods).zip(ours) {
        let error = largest([(ours.time - time).abs(), (ours.value - value).abs()]);
        worst.see(error, || format!("{value} at {time}"));
    }
    let drift = exact.durations().last().map_or(f64::NAN, |last| last.time - widths[3].0);
    let mut measured = worst.finish()?;
    measured.detail += &format!("; from the initial values of Eq. (34) the last stamp is off by {drift:.4}");
    Ok(measured)
}
