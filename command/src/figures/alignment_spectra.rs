//! Spectra of `m.n`.

use super::drawing::*;
use twofold::observables::spectrum::SpectralLine;

use super::{plain, spectrum};

/// Range of amplitudes; above the strongest line there is room for names.
const AMPLITUDES: (f64, f64) = (1e-5, 40.0);

/// Weaker lines have no names in the picture.
const NAMED: f64 = 3e-3;

pub(super) fn sheet(name: &str, subjects: &[&Subject]) -> Result<Sheet, String> {
    let highest = spectrum::highest(subjects, 2.2);
    let mut tables = Vec::new();
    let mut spectra = Vec::new();
    for subject in subjects {
        let (viewer, pulsar) = subject.line_of_sight()?;
        let (beam, observer) = (pulsar.beam(), viewer.basis());
        let of = spectrum::spectrum(subject, highest, ALIKE, |state| beam.direction(state).dot(&observer.direction))?;
        let frequency = subject.scale.frequency_column();
        tables.push(spectrum::lines_table(format!("{}-lines", subject.name), &of, frequency, "1"));
        spectra.push(of);
    }
    let caption = caption(subjects, &spectra, highest)?;
    Ok(Sheet { svg: draw(name, subjects, &spectra, highest), caption, tables })
}

const GRID: Grid = Grid { left: LEFT, top: 18.0, width: PAGE - LEFT - 10.0, height: 118.0, between: [0.0, 20.0] };

fn panel(subject: &Subject, i: usize, count: usize, highest: f64) -> Panel {
    let x = Axis::linear(subject.scale.frequency_label(), 0.0, highest);
    let y = Axis::logarithmic("amplitude of **m** · **n**", AMPLITUDES.0, AMPLITUDES.1);
    Panel::new(GRID.frame(0, i), if i + 1 == count { x } else { x.bare() }, y)
}

/// The size of names.
const SIZE: f64 = 7.0;

/// The baseline of the vertical name above a line at `x`, clear of the ticks at the left.
fn baseline(panel: &Panel, x: f64) -> f64 {
    (x + 2.5).max(panel.frame.left + 10.5)
}

/// About the length of a name: the widths of its letters in the font.
fn length(name: &str) -> f64 {
    let width = |letter: char| match letter {
        ' ' => 0.28,
        'l' => 0.23,
        _ => 0.59,
    };
    SIZE * plain(name).chars().filter(|letter| *letter != '_').map(width).sum::<f64>()
}

/// The names above lines with their places, the strongest first, as far as there is room.
fn names(panel: &Panel, lines: &[SpectralLine], highest: f64) -> Vec<([f64; 2], String)> {
    let mut names: Vec<([f64; 2], String)> = Vec::new();
    for line in lines.iter().filter(|line| line.amplitude > NAMED && line.frequency < highest) {
        let [x, y] = panel.at(line.frequency, line.amplitude);
        let name = spectrum::name(&line.combination);
        let is_apart = |other: f64| (baseline(panel, x) - baseline(panel, other)).abs() > 8.4;
        if names.iter().all(|([other, _], _)| is_apart(*other)) && y - 3.0 - length(&name) > panel.frame.top {
            names.push(([x, y], name));
        }
    }
    names
}

fn draw(name: &str, subjects: &[&Subject], spectra: &[Vec<SpectralLine>], highest: f64) -> String {
    let count = subjects.len();
    let mut page = Page::new(name, PAGE, GRID.bottom(count) + BELOW);
    for (i, (subject, lines)) in subjects.iter().zip(spectra).enumerate() {
        let panel = panel(subject, i, count, highest);
        for rate in subject.free_rates() {
            panel.upright(&mut page, rate, dashed(VERMILION, 0.9));
        }
        spectrum::draw_lines(&mut page, &panel, lines, AMPLITUDES.0, solid(BLACK, 0.7));
        for ([x, y], name) in names(&panel, lines, highest) {
            let at = [baseline(&panel, x), y - 3.0];
            page.turned_text(at, -90.0, Anchor::Start, SIZE, BLACK, &name);
        }
        panel.draw_frame(&mut page);
        panel.letter(&mut page, i, count, &subject.name);
    }
    page.finish("Spectra of the cosine of the angle between beam and line of sight")
}

fn caption(subjects: &[&Subject], spectra: &[Vec<SpectralLine>], highest: f64) -> Result<Caption, String> {
    let text = |part, words: &[_]| sentences("beam-alignment-spectra", part, words);
    let counts = subjects.iter().zip(spectra).map(|(subject, lines)| match &lines[..] {
        [] => format!("{} has no line", subject.name),
        [only] => format!("the only line of {} is {}", subject.name, spectrum::name(&only.combination)),
        [first, second, ..] => {
            format!(
                "the strongest lines of {} are {} and {}",
                subject.name,
                spectrum::name(&first.combination),
                spectrum::name(&second.combination)
            )
        }
    });
    let mut says = spectrum::sentence(&counts.collect::<Vec<_>>().join("; "));
    if subjects.len() > 1 {
        says += &format!(" {}", text("examples", &[]));
    }
    let drawn = subjects.iter().zip(spectra).enumerate();
    let names: Vec<_> = drawn
        .flat_map(|(i, (subject, lines))| names(&panel(subject, i, subjects.len(), highest), lines, highest))
        .map(|(_, name)| name)
        .collect();
    let mut shows = "Lines of **m** · **n**.".to_owned();
    if !names.is_empty() {
        let symbols = spectrum::symbols_in(&names);
        shows += &format!(" Names over the lines are combinations of mean rates: {symbols}.");
    }
    if subjects.iter().any(|subject| !subject.free_rates().is_empty()) {
        shows += " Dashed: *α* and |*γ*| of free precession, Eq. (48).";
    }
    Ok(Caption {
        shows,
        parameters: parameters(&line_of_sight(subjects, true), subjects),
        method: text("method", &spectrum::of_rates(subjects)?),
        says,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::caption_tests::assert_begins;
    use crate::figures::fixtures::{ANGLES, free, line, star};

    /// Weak lines, lines beyond the end and lines beside a stronger one have no name.
    #[test]
    fn names_are_over_strong_lines_with_room() {
        let x = Axis::linear("", 0.0, 10.0);
        let panel = Panel::new(GRID.frame(0, 0), x, Axis::logarithmic("", AMPLITUDES.0, AMPLITUDES.1));
        let apart = 10.0 / GRID.width;
        let line = |frequency: f64, amplitude: f64, symbol| line(frequency, amplitude, &[(1, symbol)]);
        // Distances in points of the picture, on both sides.
        let lines = [
            line(5.0, 1.0, "alpha'"),
            line(5.0 + 8.3 * apart, 0.9, "gamma'"),
            line(5.0 - 8.3 * apart, 0.8, "gamma'"),
            line(5.0 + 8.5 * apart, 0.7, "l'"),
            line(5.0 - 8.5 * apart, 0.6, "nu'"),
            line(10.5, 0.5, "gamma'"),
            line(1.0, 0.9 * NAMED, "gamma'"),
            line(9.0, 1.1 * NAMED, "psi'"),
        ];
        let found = names(&panel, &lines, 10.0);
        let expected = [0, 3, 4, 7]
            .map(|k| (panel.at(lines[k].frequency, lines[k].amplitude), spectrum::name(&lines[k].combination)));
        assert_eq!(found, expected);
    }

    #[test]
    fn a_caption_names_the_strongest_lines_and_what_is_drawn() {
        let (by_constants, by_angles) = (free("a"), star("b", 1.0, [0.0; 3], ANGLES));
        let of_sum = |amplitude: f64| line(1.3, amplitude, &[(1, "alpha'"), (1, "gamma'")]);
        let three = vec![line(1.4, 0.5, &[(1, "alpha'")]), of_sum(0.2), line(0.1, 0.1, &[(-1, "gamma'")])];
        let (weak, none) = (vec![of_sum(0.9 * NAMED)], Vec::new());
        let told = |subjects: &[&Subject], spectra: &[Vec<SpectralLine>]| caption(subjects, spectra, 1.35).unwrap();
        assert_begins(
            &told(&[&by_constants, &by_angles, &by_angles], &[three.clone(), weak.clone(), none]),
            [
                "Lines of **m** · **n**. Names over the lines are combinations of mean rates: *α* of the precession angle, \
                 *γ* of the rotation angle. Dashed: *α* and |*γ*| of free precession, Eq. (48).",
                "*θ*_{o} = 0.8, *φ*_{o} = 0, *χ* = 0.5, *δ* = 0, *ρ* = 0.6.",
                "Lines of the exact motion",
                "The strongest lines of a are *α* and *α* + *γ*; the only line of b is *α* + *γ*; b has no line. The peaks",
            ],
        );
        let alone = told(&[&by_angles], &[weak]);
        assert_eq!([alone.shows, alone.says], ["Lines of **m** · **n**.", "The only line of b is *α* + *γ*."]);
        assert!(told(&[&by_angles], &[three]).shows.ends_with("of the rotation angle."));
    }
}
