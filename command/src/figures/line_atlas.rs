//! Amplitudes of the lines of `m.n`, `h_+` and `h_x` by their combinations, against the size of `s` and against the wobble.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use twofold::dynamics::{BodyState, Problem, RotationState};
use twofold::observables::gravitational_wave::wave_of_state;
use twofold::observables::spectrum::{Combination, QuasiPeriodicMotion};

use super::drawing::*;
use super::examples::{OBSERVER, PULSAR};
use super::spectrum;
use twofold_verify::paper_examples::{COEFFICIENTS, spheroid};

/// `|L|`, its angle to Z, and its azimuth from X.
const MOMENTUM: f64 = 1.5;
const TILT: f64 = 0.5;
const AZIMUTH: f64 = 0.3;

/// Scale of the examples' `s`, and angle between `n` and `L` at the start; each is varied in one column and has this value in the other.
pub(super) const SCALE: f64 = 0.1;
pub(super) const WOBBLE: f64 = 0.5;

/// Powers of ten of the scale and the wobble (rad), and numbers of points.
const SCALES: (f64, f64, usize) = (-6.0, 0.0, 25);
const WOBBLES: (f64, f64, usize) = (-2.5, 0.08, 44);

/// `s_max - s_min` of the examples.
const SPREAD: f64 = COEFFICIENTS.xx - COEFFICIENTS.zz;

/// Weaker lines, relative to the strongest one, are not computed.
const WEAKEST: f64 = 1e-11;

/// Three kinds of lines: those of free precession, those that differ from them or from its constant by multiples of the slow rate, and all others.
/// For each: style, name, room in the legend, and largest number drawn per observable.
const KINDS: [(Line, &str, f64, usize); 3] = [
    (solid(BLACK, 1.3), "free precession has it", 130.0, 4),
    (dashed(BLUE, 1.1), "sideband of such a line or of the constant", 200.0, 3),
    (dash_dotted(VERMILION, 1.1), "free precession lacks it", 100.0, 3),
];

/// Observables: their names in tables and on axes.
const OBSERVABLES: [(&str, &str); 3] =
    [("m.n", "**m** · **n**"), ("h_plus", "*h*_{+} *r* / *I*^{*xx*}"), ("h_cross", "*h*_{×} *r* / *I*^{*xx*}")];

/// Range of amplitudes.
const SHOWN: (f64, f64) = (1e-10, 2.0);

/// The power of `s` is measured above this amplitude, a hundred times the error of the weakest lines.
const MEASURED: f64 = 1e-10;

/// Multiples of the nutation, the rotation about the symmetry axis and the slow precession in a line.
type Multiples = [i32; 3];

/// The lines of an observable with their amplitudes; the constant is the line without angles.
type Amplitudes = BTreeMap<Multiples, f64>;

pub(super) fn sheet() -> Result<Sheet, String> {
    let of_sizes = powers_of_ten(SCALES).map(|scale| Ok((scale * SPREAD, amplitudes(scale, WOBBLE)?)));
    let of_wobbles = powers_of_ten(WOBBLES).map(|wobble| Ok((wobble, amplitudes(SCALE, wobble)?)));
    let sweeps = [of_sizes.collect::<Result<Vec<_>, String>>()?, of_wobbles.collect::<Result<Vec<_>, String>>()?];
    let (free, here) = (amplitudes(0.0, WOBBLE)?, amplitudes(SCALE, WOBBLE)?);
    let (mut tables, mut chosen) = (Vec::new(), Vec::new());
    for (i, (name, _)) in OBSERVABLES.iter().enumerate() {
        let lines = strongest(&here[i], &free[i]);
        let variables = [("size", "s_max - s_min [1]"), ("wobble", "wobble [rad]")];
        for ((variable, head), sweep) in variables.into_iter().zip(&sweeps) {
            let unit = if i == 0 { "1" } else { "G I^xx / (c^4 t_c^2 r)" };
            let columns = lines.iter().map(|(line, _)| format!("{} [{unit}]", combination(line)));
            let mut table = Table::new(format!("{name}-{variable}"), [head.to_owned()].into_iter().chain(columns));
            for (value, all) in sweep {
                // A line below the computed range counts as zero.
                let amplitude = |(line, _): &(Multiples, usize)| all[i].get(line).copied().unwrap_or(0.0);
                table.push([*value].into_iter().chain(lines.iter().map(amplitude)).collect::<Vec<_>>());
            }
            tables.push(table);
        }
        tables.push(list(name, &lines, &tables[3 * i]));
        chosen.push(lines);
    }
    Ok(Sheet { svg: draw(&chosen, &tables), caption: caption(&chosen, &tables), tables })
}

/// The lines by their multiples, with their kinds and the power of `s` of their amplitude.
fn list(name: &str, lines: &[(Multiples, usize)], of_size: &Table) -> Table {
    let columns = ["multiple of nu' [1]", "multiple of psi' [1]", "multiple of l' [1]", "kind [1]", "power of s [1]"];
    let mut table = Table::new(format!("{name}-lines"), columns);
    for (k, (line, kind)) in lines.iter().enumerate() {
        // Slope over a decade.
        let found: Vec<_> = of_size.points(0, k + 1).into_iter().filter(|(_, size)| *size > MEASURED).collect();
        let [(from, weak), (to, strong)] = [found[0], found[4]];
        let power = (strong / weak).ln() / (to / from).ln();
        table.push(line.map(f64::from).into_iter().chain([*kind as f64, power]).collect::<Vec<_>>());
    }
    table
}

/// The star of the examples with `s` scaled, and `n` at the angle `wobble` from `L`, out of the plane of `L` and Z.
pub(super) fn star(scale: f64, wobble: f64) -> Result<Problem<f64>, twofold::Error> {
    let l = Vector3::new(TILT.sin() * AZIMUTH.cos(), TILT.sin() * AZIMUTH.sin(), TILT.cos());
    let across = Vector3::z().cross(&l).normalize();
    let axis = l * wobble.cos() + across * wobble.sin();
    let equatorial_axis = across * wobble.cos() - l * wobble.sin();
    let start = BodyState { axis, momentum: l * MOMENTUM, equatorial_axis };
    Problem::new(spheroid(), COEFFICIENTS.scaled(scale).tensor(), start)
}

/// The lines of all observables.
fn amplitudes(scale: f64, wobble: f64) -> Result<[Amplitudes; 3], String> {
    let problem = star(scale, wobble)?;
    let motion = QuasiPeriodicMotion::new(&problem)?;
    let (observer, beam) = (OBSERVER.basis(), PULSAR.beam());
    let wave = |state: &BodyState<f64>| {
        wave_of_state(problem.spheroid(), problem.coefficients(), &state.axis_state(), &observer)
    };
    let lines = |function: &dyn Fn(&BodyState<f64>) -> f64| {
        let list = motion.lines(WEAKEST, |state| Ok::<_, twofold::Error>([function(state), 1.0]))?;
        let named = list.lines.iter().map(|line| (multiples(&motion, &line.combination), line.amplitude));
        let constant = Some(([0; 3], list.constant.abs())).filter(|(_, size)| *size > list.least);
        Ok::<_, twofold::Error>(named.chain(constant).collect::<Amplitudes>())
    };
    Ok([
        lines(&|state| beam.direction(state).dot(&observer.direction))?,
        lines(&|state| wave(state).plus)?,
        lines(&|state| wave(state).cross)?,
    ])
}

/// A line by nutation, rotation about the symmetry axis and slow precession, which name it independently of the Euler angles; the first nonzero
/// multiple is positive.
fn multiples(motion: &QuasiPeriodicMotion, combination: &Combination) -> Multiples {
    let frequencies = motion.frequencies();
    let mut left = [0; 3];
    let mut add = |k: i32, turns: [i32; 3]| (0..3).for_each(|i| left[i] += k * turns[i]);
    frequencies.basis.iter().for_each(|of| add(combination.multiple(of.symbol), of.turns));
    // Only psi' depends on the third angle of the torus; of the others only nu' depends on the first.
    let mut found = [0; 3];
    for (place, symbol, angle) in [(1, "psi'", 2), (0, "nu'", 0), (2, "l'", 1)] {
        let of = frequencies.all.iter().find(|of| of.symbol == symbol);
        if let Some(turns) = of.map(|of| of.turns) {
            let k = left[angle] * turns[angle];
            found[place] = k;
            (0..3).for_each(|i| left[i] -= k * turns[i]);
        }
    }
    let sign = found.iter().find(|k| **k != 0).map_or(1, |k| k.signum());
    found.map(|k| k * sign)
}

/// Index in [`KINDS`].
fn kind([nutation, rotation, slow]: &Multiples, free: &Amplitudes) -> usize {
    match free.contains_key(&[*nutation, *rotation, 0]) {
        true => usize::from(*slow != 0),
        false => 2,
    }
}

/// The strongest lines of each kind, with their kinds; of lines that differ only by the slow rate the strongest.
fn strongest(all: &Amplitudes, free: &Amplitudes) -> Vec<(Multiples, usize)> {
    let mut lines: Vec<_> = all.iter().filter(|(line, _)| **line != [0; 3]).collect();
    lines.sort_by(|a, b| b.1.total_cmp(a.1));
    let mut chosen: Vec<(Multiples, usize)> = Vec::new();
    for (wanted, (.., most)) in KINDS.iter().enumerate() {
        let mut of_kind: Vec<Multiples> = Vec::new();
        for (line, _) in lines.iter().filter(|(line, _)| kind(line, free) == wanted) {
            if of_kind.len() < *most && of_kind.iter().all(|other| other[..2] != line[..2]) {
                of_kind.push(**line);
            }
        }
        chosen.extend(of_kind.into_iter().map(|line| (line, wanted)));
    }
    chosen
}

fn combination([nutation, rotation, slow]: &Multiples) -> Combination {
    Combination { terms: vec![(*nutation, "nu'"), (*rotation, "psi'"), (*slow, "l'")] }
}

fn draw(chosen: &[Vec<(Multiples, usize)>], tables: &[Table]) -> String {
    let (names, between) = (54.0, 42.0);
    let width = (PAGE - LEFT - 2.0 * names - between) / 2.0;
    let grid = Grid { left: LEFT, top: 18.0, width, height: 112.0, between: [names + between, 20.0] };
    let bottom = grid.bottom(chosen.len()) + BELOW;
    let mut page = Page::new("line-atlas", PAGE, bottom + 14.0);
    let x = [
        (Axis::logarithmic("*s*_{max} − *s*_{min}", SPREAD * 10f64.powf(SCALES.0), SPREAD), SPREAD * SCALE),
        (Axis::logarithmic("wobble [rad]", 10f64.powf(WOBBLES.0), 10f64.powf(WOBBLES.1)), WOBBLE),
    ];
    for (i, (lines, (_, label))) in chosen.iter().zip(OBSERVABLES).enumerate() {
        for (column, (x, other)) in x.iter().enumerate() {
            let y = Axis::logarithmic(&format!("amplitude of {label}"), SHOWN.0, SHOWN.1);
            let x = if i + 1 < chosen.len() { x.bare() } else { x.clone() };
            let panel = Panel::new(grid.frame(column, i), x, if column == 0 { y } else { y.unnamed() });
            let table = &tables[3 * i + column];
            panel.upright(&mut page, *other, dotted(GREY, 0.8));
            let mut ends = Vec::new();
            for (k, (line, kind)) in lines.iter().enumerate() {
                let points: Vec<_> = table.points(0, k + 1).into_iter().filter(|(_, size)| *size > 0.0).collect();
                panel.curve(&mut page, &points, KINDS[*kind].0);
                if let Some(&(at, last)) = points.last() {
                    let name = spectrum::name(&combination(line));
                    ends.push((panel.at(at, last), name, KINDS[*kind].0.colour));
                }
            }
            panel.draw_frame(&mut page);
            panel.letter(&mut page, 2 * i + column, 6, "");
            name_ends(&mut page, panel.frame, ends);
        }
    }
    let samples: Vec<_> = KINDS.iter().map(|(line, name, width, _)| (Sample::Line(*line), *name, *width)).collect();
    legend_row(&mut page, [LEFT, bottom + 8.0], &samples);
    page.finish("Amplitudes of spectral lines against the size of s and the wobble")
}

fn caption(chosen: &[Vec<(Multiples, usize)>], tables: &[Table]) -> Caption {
    let of_observable = |(i, lines): (usize, &Vec<(Multiples, usize)>)| {
        let lacking = lines.iter().zip(&tables[3 * i + 2].rows).filter(|((_, kind), _)| *kind == KINDS.len() - 1);
        let power = |((line, _), row): (&(Multiples, usize), &Vec<f64>)| {
            format!("{} {:.2}", spectrum::name(&combination(line)), row[4])
        };
        let name = OBSERVABLES[i].1.split(" *r*").next().unwrap_or_default();
        format!("of {name} {}", lacking.map(power).collect::<Vec<_>>().join(", "))
    };
    let powers = chosen.iter().enumerate().map(of_observable).collect::<Vec<_>>().join("; ");
    let numbers =
        [("momentum", MOMENTUM), ("tilt", TILT), ("azimuth", AZIMUTH), ("size", SCALE * SPREAD), ("wobble", WOBBLE)];
    let [chi, delta] = [PULSAR.chi, PULSAR.delta];
    let sight =
        format!("*θ*_{{o}} = {}, *φ*_{{o}} = {}, *χ* = {chi}, *δ* = {delta}.", OBSERVER.theta_o, OBSERVER.phi_o);
    let words = [("powers", powers), ("sight", sight), ("motions", (SCALES.2 + WOBBLES.2 + 2).to_string())];
    let numbers = numbers.map(|(name, value)| (name, significant(value, 3)));
    Caption::of("line-atlas", &[&words[..], &numbers].concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_star_has_the_tilt_and_the_wobble_that_are_told() {
        for wobble in [0.0032, 0.5, 1.2] {
            let problem = star(0.3, wobble).unwrap();
            let BodyState { axis, momentum, equatorial_axis } = *problem.initial();
            let l = momentum / MOMENTUM;
            assert!((l.norm() - 1.0).abs() < 1e-15);
            assert!((l.z - TILT.cos()).abs() < 1e-15 && (l.y.atan2(l.x) - AZIMUTH).abs() < 1e-15);
            // Out of the plane of L and Z, on the right-hand side.
            let beside = Vector3::z().cross(&l) / TILT.sin();
            assert!((axis.dot(&l) - wobble.cos()).abs() < 1e-15 && (axis.dot(&beside) - wobble.sin()).abs() < 1e-15);
            assert!((axis.norm() - 1.0).abs() < 1e-15 && axis.dot(&equatorial_axis).abs() < 1e-15);
            assert_eq!(*problem.coefficients(), COEFFICIENTS.scaled(0.3).tensor());
        }
    }

    /// The constant is not a line; of lines that differ by `l` alone the strongest of a kind remains; the number per kind is limited.
    #[test]
    fn the_strongest_lines_of_each_kind_are_chosen() {
        let of = |lines: &[(Multiples, f64)]| lines.iter().copied().collect::<Amplitudes>();
        let free = [
            ([0, 0, 0], 0.9),
            ([1, 0, 0], 0.5),
            ([0, 1, 0], 0.45),
            ([1, 1, 0], 0.35),
            ([2, 0, 0], 0.25),
            ([3, 1, 0], 0.15),
        ];
        let satellites = [
            ([1, 0, 1], 0.4),
            ([1, 0, -1], 0.3),
            ([0, 0, 2], 0.2),
            ([0, 0, 1], 0.19),
            ([3, 1, 1], 0.05),
            ([2, 0, 1], 0.01),
        ];
        let others = [([2, 1, 0], 0.1), ([2, 1, 1], 0.3), ([3, 0, 0], 0.02), ([3, 2, -1], 0.03), ([4, 0, 0], 0.01)];
        let expected = [
            ([1, 0, 0], 0),
            ([0, 1, 0], 0),
            ([1, 1, 0], 0),
            ([2, 0, 0], 0),
            ([1, 0, 1], 1),
            ([0, 0, 2], 1),
            ([3, 1, 1], 1),
            ([2, 1, 1], 2),
            ([3, 2, -1], 2),
            ([3, 0, 0], 2),
        ];
        assert_eq!(strongest(&of(&[&free[..], &satellites, &others].concat()), &of(&free)), expected);
    }

    /// From the first row above the rounding to the fourth after it, which is a decade: 1e-9 at 0.01 and 1e-6 at 0.1 give the power 3, whatever the
    /// other rows are.
    #[test]
    fn the_power_of_a_line_is_that_over_a_decade_above_the_rounding() {
        let mut table = Table::new("", ["size", "a", "b"]);
        for (size, a, b) in [
            (0.005, 0.9 * MEASURED, 0.5),
            (0.01, 1e-9, 0.5),
            (0.02, 7e-9, 0.7),
            (0.03, 3e-9, 0.6),
            (0.05, 9e-9, 0.05),
            (0.1, 1e-6, 0.2),
            (0.2, 2e-6, 0.9),
        ] {
            table.push([size, a, b]);
        }
        let list = list("m.n", &[([1, -2, 3], 2), ([4, 5, 6], 1)], &table);
        assert_eq!(list.name, "m.n-lines");
        assert_eq!(list.rows[0][..4], [1.0, -2.0, 3.0, 2.0]);
        assert_eq!(list.rows[1][..4], [4.0, 5.0, 6.0, 1.0]);
        // From 0.005 to 0.05 the other falls from 0.5 to 0.05.
        assert!((list.rows[0][4] - 3.0).abs() < 1e-14 && (list.rows[1][4] + 1.0).abs() < 1e-14, "{list:?}");
    }

    /// 25 sizes, 44 wobbles, the star common to both columns and the one without Lorentz violation.
    #[test]
    fn a_caption_tells_the_powers_of_what_free_precession_lacks() {
        let chosen = [
            vec![([1, 0, 0], 0), ([2, 0, 0], 2), ([1, -1, 0], 2)],
            vec![([0, 0, 2], 2)],
            vec![([1, 0, 1], 1), ([0, 1, 2], 2)],
        ];
        let mut tables = vec![Table::new("", ["nothing"; 5]); 9];
        for (i, powers) in [vec![0.125, 1.25, 0.75], vec![2.0], vec![0.625, 1.0]].into_iter().enumerate() {
            powers.into_iter().for_each(|power| tables[3 * i + 2].push([0.0, 0.0, 0.0, 0.0, power]));
        }
        let told = caption(&chosen, &tables);
        let powers = "of **m** · **n** 2 *ν* 1.25, *ν* − *ψ* 0.75; of *h*_{+} 2 *l* 2.00; of *h*_{×} *ψ* + 2 *l* 1.00.";
        assert!(told.says.contains(&format!("powers of *s*: {powers}")), "{}", told.says);
        assert!(told.method.contains("; 71 motions, of which"), "{}", told.method);
        assert!(
            told.shows.contains("wobble of 0.5 rad.") && told.shows.contains("= 0.006. A dotted"),
            "{}",
            told.shows
        );
        let parameters = "|**L**| = 1.5, at 0.5 rad to *Z* and 0.3 rad from *X*; **e**_{*z*} beside the plane of **L** and *Z*. \
                          *θ*_{o} = 0.8, *φ*_{o} = 0, *χ* = 0.5, *δ* = 0.";
        assert!(told.parameters.ends_with(parameters), "{}", told.parameters);
    }
}
