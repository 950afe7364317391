//! Spectra of `h_+` and `h_x`, with the third harmonic enlarged.

use twofold::dynamics::BodyState;
use twofold::observables::gravitational_wave::Polarizations;
use twofold::observables::spectrum::SpectralLine;

use super::drawing::*;
use super::spectrum;
use super::waves;

const LINE: Line = solid(BLACK, 0.8);

/// Half of the width of the inset, relative to the fundamental rate of the harmonics.
const INSET: f64 = 0.22;

/// An inset is drawn for amplitudes above this fraction of the largest.
const ENLARGED: f64 = 1e-5;

/// The lines of both polarizations.
type Both = [Vec<SpectralLine>; 2];

pub(super) fn sheet(name: &str, subjects: &[&Subject]) -> Result<Sheet, String> {
    let highest = spectrum::highest(subjects, 3.7);
    let mut tables = Vec::new();
    let mut spectra = Vec::new();
    for subject in subjects {
        let polarization = |state: &BodyState<f64>, of: fn(Polarizations<f64>) -> f64| {
            // There is an observer.
            waves::wave(subject, state).map_or(f64::NAN, of)
        };
        let error = waves::error(subject);
        let both = [
            spectrum::spectrum(subject, highest, error, |state| polarization(state, |h| h.plus))?,
            spectrum::spectrum(subject, highest, error, |state| polarization(state, |h| h.cross))?,
        ];
        let (frequency, unit) = (subject.scale.frequency_column(), subject.scale.wave_column_unit());
        for (polarization, lines) in ["plus", "cross"].iter().zip(&both) {
            let name = format!("{}-{polarization}-lines", subject.name);
            tables.push(spectrum::lines_table(name, lines, frequency.clone(), unit));
        }
        spectra.push(both);
    }
    let caption = caption(subjects, &spectra, highest)?;
    Ok(Sheet { svg: draw(name, subjects, &spectra, highest)?, caption, tables })
}

/// Largest amplitude.
fn largest(both: &Both) -> f64 {
    both.iter().flatten().map(|line| line.amplitude).fold(0.0, f64::max)
}

/// Whether a wave exceeds the error of the motion; otherwise there are no lines.
fn radiates(both: &Both) -> bool {
    both.iter().any(|lines| !lines.is_empty())
}

/// The rate of `alpha`, the fundamental of the wave's harmonics, in the unit of the figure; `None` if there is nothing to
/// enlarge near its third harmonic.
fn fundamental(subject: &Subject, both: &Both, highest: f64) -> Result<Option<f64>, String> {
    let rate = subject.quasi_periodic()?.frequencies().rate("alpha'");
    let rate = rate.map(|rate| subject.scale.frequency(rate.abs()));
    let is_seen = |rate: &f64| {
        let near = both.iter().flat_map(|lines| part(lines, *rate)).map(|line| line.amplitude).fold(0.0, f64::max);
        (3.0 + INSET) * rate < highest && near > ENLARGED * largest(both)
    };
    Ok(rate.filter(is_seen))
}

/// The lines near three times a rate.
fn part(lines: &[SpectralLine], rate: f64) -> impl Iterator<Item = &SpectralLine> {
    lines.iter().filter(move |line| (line.frequency - 3.0 * rate).abs() < INSET * rate)
}

fn draw(name: &str, subjects: &[&Subject], spectra: &[Both], highest: f64) -> Result<String, String> {
    let grid = Grid::two_rows(subjects.len(), 98.0, 44.0);
    let mut page = Page::new(name, PAGE, grid.bottom(2) + BELOW);
    // Both stars and polarizations have the same scale, so that amplitudes can be compared.
    let most = subjects.iter().zip(spectra).map(|(s, both)| largest(both).max(waves::error(s))).fold(0.0, f64::max);
    let most = if most > 0.0 { most } else { 1.0 };
    for (i, (subject, both)) in subjects.iter().zip(spectra).enumerate() {
        let rate = fundamental(subject, both, highest)?;
        for (polarization, (lines, symbol)) in both.iter().zip(["*h*_{+}", "*h*_{×}"]).enumerate() {
            let frame = grid.frame(i, polarization);
            let x = Axis::linear(subject.scale.frequency_label(), 0.0, highest);
            let y = Axis::linear(&format!("amplitude of {symbol}"), 0.0, 1.05 * most);
            let panel = Panel::new(frame, if polarization == 0 { x.bare() } else { x }, y);
            if let Some(free) = subject.free_rates().first() {
                [*free, 2.0 * free].iter().for_each(|rate| panel.upright(&mut page, *rate, dashed(VERMILION, 0.9)));
            }
            spectrum::draw_lines(&mut page, &panel, lines, 0.0, LINE);
            if !radiates(both) {
                panel.remark(&mut page, "below the error of the numerical motion");
            }
            panel.draw_frame(&mut page);
            if polarization == 0 {
                panel.letter(&mut page, i, subjects.len(), &subject.name);
            }
            if let Some(rate) = rate {
                inset(&mut page, frame, rate, lines);
            }
        }
    }
    Ok(page.finish("Spectra of the gravitational waves"))
}

/// The spectrum near three times `rate` with its own scale, in the upper right of the frame.
fn inset(page: &mut Page, frame: Rectangle, rate: f64, lines: &[SpectralLine]) {
    let part: Vec<_> = part(lines, rate).cloned().collect();
    let most = part.iter().map(|line| line.amplitude).fold(f64::MIN_POSITIVE, f64::max);
    let inner = Rectangle {
        left: frame.left + 0.65 * frame.width,
        top: frame.top + 17.0,
        width: 0.31 * frame.width,
        height: 0.48 * frame.height,
    };
    let x = Axis::linear("", (3.0 - INSET) * rate, (3.0 + INSET) * rate);
    let panel = Panel::new(inner, x, Axis::linear("", 0.0, 1.15 * most));
    panel.upright(page, 3.0 * rate, dotted("#404040", 0.8));
    spectrum::draw_lines(page, &panel, &part, 0.0, LINE);
    panel.draw_frame(page);
    let power = match panel.y_power() {
        0 => String::new(),
        power => format!(" [{}]", power_of_ten(power)),
    };
    page.text([inner.right(), inner.top - 4.0], Anchor::End, SMALL, "#000000", &format!("near 3 d*α*/d*t*{power}"));
}

fn caption(subjects: &[&Subject], spectra: &[Both], highest: f64) -> Result<Caption, String> {
    let says: Vec<_> = subjects.iter().zip(spectra).map(|(subject, both)| findings(subject, both)).collect();
    let mut shows = format!("Lines of *h*_{{+}} (top) and *h*_{{×}} (bottom), {}", subjects[0].scale.wave_unit());
    let mut insets = Vec::new();
    for (subject, both) in subjects.iter().zip(spectra) {
        insets.extend(fundamental(subject, both, highest)?);
    }
    if !insets.is_empty() {
        shows += "; the insets enlarge what is near three times the mean rate of *α* (dotted)";
    }
    shows += ".";
    if subjects.iter().any(|subject| !subject.free_rates().is_empty()) {
        shows += " Dashed: *α* and 2*α* of free precession, Eq. (48).";
    }
    Ok(Caption {
        shows,
        parameters: parameters(&line_of_sight(subjects, false), subjects),
        method: sentences("wave-spectra", "method", &spectrum::of_rates(subjects)?),
        says: says.join(" "),
    })
}

/// The findings from the spectra of a motion.
fn findings(subject: &Subject, both: &Both) -> String {
    if !radiates(both) {
        let error = significant(waves::error(subject), 1);
        return format!(
            "The amplitudes of {} are below {error}, what the error of the numerical motion makes.",
            subject.name
        );
    }
    let firsts = ["*h*_{×}", "*h*_{+}"].into_iter().zip(both.iter().rev());
    let firsts = firsts.filter_map(|(symbol, lines)| Some((symbol, lines, lines.first()?)));
    let (symbol, strongest, first) =
        firsts.max_by(|(.., a), (.., b)| a.amplitude.total_cmp(&b.amplitude)).expect("a line");
    let name = |line: &SpectralLine| {
        format!(
            "{}, at {} {}",
            spectrum::name(&line.combination),
            number(line.frequency),
            subject.scale.frequency_unit()
        )
    };
    let multiple = |line: &SpectralLine, symbol: &str| line.combination.multiple(symbol).abs();
    let part = |line: &SpectralLine| significant(line.amplitude / first.amplitude, 2);
    let mut says = format!(
        "The strongest line of {} is in {symbol}: {}, of an amplitude of {}",
        subject.name,
        name(first),
        significant(first.amplitude, 3)
    );
    if let Some(third) = strongest.iter().find(|line| multiple(line, "alpha'") == 3) {
        says +=
            &format!("; the strongest of the third harmonic of {symbol}, {}, has {} of it", name(third), part(third));
    }
    let slow = strongest.iter().find(|line| multiple(line, "l'") == 1 && multiple(line, "alpha'") == 0);
    if let Some(slow) = slow {
        says += &format!("; the slow frequency *l* by itself has {} of it", part(slow));
    }
    says + "."
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::caption_tests::assert_begins;
    use crate::figures::fixtures::{self, ANGLES, CONSTANTS, star};

    fn line(frequency: f64, amplitude: f64) -> SpectralLine {
        fixtures::line(frequency, amplitude, &[])
    }

    #[test]
    fn what_is_enlarged_is_near_the_third_harmonic() {
        let lines: Vec<_> = [5.5, 5.57, 6.0, 6.43, 6.45, 2.0].map(|frequency| line(frequency, 1.0)).into();
        let near: Vec<_> = part(&lines, 2.0).map(|line| line.frequency).collect();
        assert_eq!(near, [5.57, 6.0, 6.43]);
    }

    #[test]
    fn the_largest_line_is_of_either_polarization() {
        let both = [vec![line(1.0, 1e-30), line(2.0, 3e-30)], vec![line(1.0, 2e-30)]];
        assert_eq!(largest(&both), 3e-30);
        assert_eq!(largest(&[vec![], vec![line(1.0, 2e-30)]]), 2e-30);
        assert_eq!(largest(&[vec![], vec![]]), 0.0);
    }

    /// At three times `alpha'`, which is 1.1 / cos 0.7 in either direction, for axes up to 3.22 times it. The wave of a physical star has amplitudes
    /// of 1e-30.
    #[test]
    fn an_inset_is_there_for_what_it_enlarges() {
        let third = 3.3 / 0.7_f64.cos();
        let both = |frequency: f64, amplitude: f64| [vec![line(0.5, 1e-30)], vec![line(frequency, amplitude)]];
        for spin in [1.0, -1.0] {
            let star = star("a", spin, [0.0; 3], CONSTANTS);
            let rate = |both: &Both, highest: f64| fundamental(&star, both, highest).unwrap();
            let seen = rate(&both(third, 1.1e-35), 1.08 * third).expect("an inset");
            assert!((3.0 * seen / third - 1.0).abs() < 1e-13, "{seen}");
            assert_eq!(rate(&both(third, 0.9e-35), 1.08 * third), None, "too weak");
            assert_eq!(rate(&both(1.08 * third, 1e-31), 2.0 * third), None, "elsewhere");
            assert_eq!(rate(&both(third, 1e-31), 1.07 * third), None, "beyond the end");
            assert_eq!(rate(&[vec![], vec![]], 2.0 * third), None, "nothing");
        }
        // Here `alpha` does not circulate.
        assert_eq!(fundamental(&fixtures::tone(-1.0, 1.0), &both(0.0, 1e-30), 300.0).unwrap(), None);
    }

    /// The unit of the wave is that of the paper; the error is `1e-11 epsilon (1.1 / cos 0.7)^2`.
    #[test]
    fn a_caption_tells_the_strongest_lines_and_what_is_drawn() {
        let rate = 1.1 / 0.7_f64.cos();
        let (by_constants, by_angles) = (fixtures::free("a"), star("b", 1.0, [0.0; 3], ANGLES));
        let once = |amplitude: f64| fixtures::line(1.5, amplitude, &[(1, "alpha'")]);
        let third = fixtures::line(3.0 * rate, 0.25, &[(-3, "alpha'"), (1, "gamma'")]);
        let beside = fixtures::line(1.25, 0.125, &[(1, "alpha'"), (1, "l'")]);
        let slow = fixtures::line(0.5, 0.0625, &[(-1, "l'")]);
        let told = |subjects: &[&Subject], spectra: &[Both]| caption(subjects, spectra, 5.0).unwrap();
        let spectra =
            [[vec![once(0.5)], vec![once(1.0), third, beside, slow]], [vec![], vec![]], [vec![once(2.0)], vec![]]];
        assert_begins(
            &told(&[&by_constants, &by_angles, &by_angles], &spectra),
            [
                "Lines of *h*_{+} (top) and *h*_{×} (bottom), in units of *G* *I*^{*xx*} / (*c*^{4} *t*_{c}^{2} *r*); the insets \
                 enlarge what is near three times the mean rate of *α* (dotted). Dashed: *α* and 2*α* of free precession, Eq. (48).",
                "*θ*_{o} = 0.8, *φ*_{o} = 0. *ε* = 0.1",
                "Waves by Eqs. (59)",
                "The strongest line of a is in *h*_{×}: *α*, at 1.5 rad/*t*_{c}, of an amplitude of 1; the strongest of the third harmonic \
                 of *h*_{×}, −3 *α* + *γ*, at 4.31462 rad/*t*_{c}, has 0.25 of it; the slow frequency *l* by itself has 0.062 of it. \
                 The amplitudes of b are below 2 × 10^{−12}, what the error of the numerical motion makes. The strongest line of b is in \
                 *h*_{+}: *α*, at 1.5 rad/*t*_{c}, of an amplitude of 2.",
            ],
        );
        let alone = told(&[&by_angles], &[[vec![once(1.0)], vec![once(1.0)]]]);
        assert!(alone.shows.ends_with("*r*)."), "{}", alone.shows);
        // Of equal lines the first counts.
        assert_eq!(alone.says, "The strongest line of b is in *h*_{+}: *α*, at 1.5 rad/*t*_{c}, of an amplitude of 1.");
    }
}
