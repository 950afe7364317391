//! The pulse train: against a scan, a closed form, grazing pulses by construction and the authors' data. Eq. (44).

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Vector3};
use twofold::Error;
use twofold::dynamics::{BodyState, RigidSpheroid};
use twofold::euler_angles::{EulerAngles, EulerRates};
use twofold::observables::pulsar::width::{PulseWidth, pulse_width};
use twofold::observables::pulsar::{Beam, PulseTrain, pulse_train};
use twofold::propagation::{AxisMotion, Motion, TaylorMotion, propagate};

use crate::check::{Bound, Check, Kind, Measured, Worst, largest};
use crate::physical_domain::scenes;
use crate::random::Random;
use crate::reference::{ReferenceMotion, reference_motion};

pub(super) fn checks() -> Vec<Check> {
    vec![
        Check {
            id: "pulse-train-scan",
            kind: Kind::Oracle,
            equations: &[44, 47],
            statement: "the edges of both beams over 20 t_c are as many as a scan of m.n finds, 2,000 points with each extremum between them refined",
            figure: "trains with a wrong number of edges, or inside where the scan is outside, of 10,000 random ones",
            bound: Bound::AtMost(0.0),
            reason: "counts; the scan passes over no pair of edges, since it looks at every extremum",
            measure: against_scan,
        },
        Check {
            id: "pulse-train-edges",
            kind: Kind::Property,
            equations: &[44],
            statement: "at every edge of 600 random trains m.n is cos rho",
            figure: "largest |m.n - cos rho| / (2.2e-16 (4 + t |Omega|))",
            bound: Bound::AtMost(2.0),
            reason: "some roundings of m.n, and the rounding of t by half an ulp and of Newton's step by one",
            measure: margin_at_edges,
        },
        Check {
            id: "pulse-train-closed-form",
            kind: Kind::Oracle,
            equations: &[44, 51, 53, 56],
            statement: "the trains of a star that spins about Z are those of Eqs. (51), (56), exact there: pulses, always on (the beam covers the pole) \
                 and never on",
            figure: "largest error of an edge / (2.2e-16 (1 + t) times the edge's sensitivity); infinite for a wrong number",
            bound: Bound::AtMost(16.0),
            reason: "the phase of a numerical motion of 100 steps is in error by some ten ulp",
            measure: against_closed_form,
        },
        Check {
            id: "pulse-train-grazing",
            kind: Kind::Property,
            equations: &[44],
            statement: "with cos rho at an extremum of m.n, plus or minus 1e-10 to 1e-12, the short pulse (or gap) is there or is not, and lasts \
                 2 sqrt(2 d / |f''|); with cos rho at the extremum, a grazing is reported",
            figure: "largest relative error of the short duration; infinite for a wrong number of edges",
            bound: Bound::AtMost(1e-2),
            reason: "m.n - cos rho = 1e-12 has 4e-4 of rounding and of the motion's error; the next term of the duration is 1e-5",
            measure: grazing_by_construction,
        },
        Check {
            id: "pulse-train-symmetries",
            kind: Kind::Property,
            equations: &[44],
            statement: "the opposite beam with the supplement of rho is on exactly between the pulses, and a part of the span gives the same pulses, cut",
            figure: "largest difference of an edge; infinite for a wrong number",
            bound: Bound::AtMost(1e-13),
            reason: "the same roots from other brackets: rounding of t up to 40 t_c, 7e-15, and of m.n over its slope",
            measure: symmetries,
        },
        Check {
            id: "pulse-train-authors",
            kind: Kind::Oracle,
            equations: &[44, 47],
            statement: "m.n at t = 0, and widths and periods of tp-I from the initial values rounded as in the caption, are the authors' \
                 published data for tp-I: chi = 0.5, delta = 0, theta_o = 0.8, phi_o = 0, rho = 0.6",
            figure: "largest difference of a time stamp, width or period [t_c]",
            bound: Bound::AtMost(1e-5),
            reason: "their solver ran at its default tolerance: m.n is off by up to 2.7e-6, at a slope of about 0.3 per t_c",
            measure: against_authors,
        },
    ]
}

/// A random motion over 20 t_c with a beam and an observer.
struct Case {
    name: String,
    motion: TaylorMotion<f64>,
    beam: Beam<f64>,
    observer: Vector3<f64>,
}

const SPAN: (f64, f64) = (0.0, 20.0);

impl Case {
    fn margin(&self, t: f64) -> [f64; 3] {
        let motion = &self.motion;
        let state = motion.state(t).expect("a time of the span");
        self.beam.margin_rates(motion.spheroid(), motion.violation(), &state, &self.observer)
    }

    fn train(&self) -> Result<PulseTrain, String> {
        pulse_train(&self.motion, &self.beam, &self.observer, SPAN).map_err(|e| format!("{}: {e}", self.name))
    }
}

/// Sees `count` random scenes, each with a random beam and its opposite.
fn for_random_cases(seed: u8, count: usize, mut see: impl FnMut(&Case) -> Result<(), String>) -> Result<(), String> {
    let mut random = Random::with_seed(u64::from(seed));
    let mut index = 0;
    let cell = std::cell::RefCell::new((&mut random, &mut index, &mut see));
    crate::physical_domain::worst_over(seed, count, &scenes(), |scene| {
        let (random, index, see) = &mut *cell.borrow_mut();
        let motion = propagate(&scene.spheroid(), &scene.coefficients().tensor(), &scene.state(), SPAN, 1e-14)
            .map_err(|e| e.to_string())?;
        let (chi, delta) = (random.within(0.0, PI), random.within(-PI, PI));
        let (theta, phi) = (random.within(0.0, PI), random.within(-PI, PI));
        let observer = Vector3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
        let beam = Beam::new(chi, delta, random.within(0.05, 2.0));
        let name = format!("scene {index} of seed {seed}, beam {beam:?}, observer {observer:?}");
        let mut case = Case { name, motion, beam, observer };
        see(&case)?;
        case.beam = beam.opposite();
        see(&case)?;
        **index += 1;
        Ok(0.0)
    })
    .map(|_| ())
}

fn edges(train: &PulseTrain) -> Vec<f64> {
    let pulses = train.pulses.iter();
    pulses.flat_map(|p| [(!p.cut_at_start).then_some(p.start), (!p.cut_at_end).then_some(p.end)]).flatten().collect()
}

fn against_scan() -> Result<Measured, String> {
    let (mut wrong, mut total, mut trains, mut first) = (0, 0, 0, String::new());
    for_random_cases(44, 5000, |case| {
        let train = case.train()?;
        let (count, points) = scan(case);
        let inside = |t: f64| train.pulses.iter().any(|p| p.start <= t && t <= p.end);
        let differ = points.iter().any(|&(t, margin)| margin.abs() > 1e-12 && inside(t) != (margin > 0.0));
        trains += 1;
        total += count;
        if edges(&train).len() != count || differ || !train.grazings.is_empty() {
            wrong += 1;
            if first.is_empty() {
                first = format!("; first {}, {count} edges by the scan, {}", case.name, edges(&train).len());
            }
        }
        Ok(())
    })?;
    if total < 1000 {
        return Err(format!("only {total} edges were met"));
    }
    Ok(Measured::new(f64::from(wrong), format!("{trains} trains with {total} edges{first}")))
}

/// Number of edges of a case, and the margin on the grid. Only values of `m.n` and signs of its rate are used.
fn scan(case: &Case) -> (usize, Vec<(f64, f64)>) {
    let grid: Vec<[f64; 3]> = (0..=2000)
        .map(|i| {
            let t = SPAN.1 * f64::from(i) / 2000.0;
            let [margin, rate, _] = case.margin(t);
            [t, margin, rate]
        })
        .collect();
    let mut count = 0;
    for pair in grid.windows(2) {
        let ([mut low, first, rate], [mut high, second, next_rate]) = (pair[0], pair[1]);
        if (first > 0.0) != (second > 0.0) {
            count += 1;
        } else if (rate > 0.0) != (next_rate > 0.0) {
            while high - low > 1e-9 {
                let middle = (low + high) / 2.0;
                if (case.margin(middle)[1] > 0.0) == (rate > 0.0) { low = middle } else { high = middle }
            }
            if (case.margin((low + high) / 2.0)[0] > 0.0) != (first > 0.0) {
                count += 2;
            }
        }
    }
    (count, grid.into_iter().map(|[t, margin, _]| (t, margin)).collect())
}

fn margin_at_edges() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for_random_cases(45, 300, |case| {
        for t in edges(&case.train()?) {
            let state = case.motion.state(t).map_err(|e| e.to_string())?;
            let turning = state.momentum.norm() / case.motion.spheroid().inertia_zz.min(1.0);
            let scale = f64::EPSILON * (4.0 + t * turning);
            worst.see(case.margin(t)[0].abs() / scale, || format!("t = {t}, {}", case.name));
        }
        Ok(())
    })?;
    worst.finish()
}

fn against_closed_form() -> Result<Measured, String> {
    let (mut random, mut worst, mut kinds) = (Random::with_seed(53), Worst::default(), [0; 3]);
    for case in 0..400 {
        let [chi, theta_o] = [0; 2].map(|_| random.within(0.01, PI - 0.01));
        let (phi_o, delta, rho) = (random.within(-PI, PI), random.within(-PI, PI), random.within(0.05, 2.5));
        let spin = random.within(0.3, 2.0);
        let spheroid = RigidSpheroid::in_units_of_tc(random.within(0.5, 1.8));
        let upright = EulerAngles { alpha: 0.0, beta: 0.0, gamma: 0.0 };
        let start = BodyState::from_angles(&spheroid, &upright, &EulerRates { alpha: 0.0, beta: 0.0, gamma: spin });
        let motion = propagate(&spheroid, &Matrix3::zeros(), &start, SPAN, 1e-15).map_err(|e| e.to_string())?;
        let observer = Vector3::new(theta_o.sin() * phi_o.cos(), theta_o.sin() * phi_o.sin(), theta_o.cos());
        let beam = Beam::new(chi, delta, rho);
        let train = pulse_train(&motion, &beam, &observer, SPAN).map_err(|e| e.to_string())?;
        let figure = match pulse_width(rho, chi, theta_o) {
            PulseWidth::Pulsed(width) => {
                kinds[0] += 1;
                let mut expected: Vec<f64> = (-4..20)
                    .flat_map(|k| [-width / 2.0, width / 2.0].map(|w| (phi_o - delta + TAU * f64::from(k) + w) / spin))
                    .filter(|t| SPAN.0 < *t && *t < SPAN.1)
                    .collect();
                expected.sort_by(f64::total_cmp);
                let found = edges(&train);
                // m.n changes by sin Theta sin theta_o sin(W/2) per radian.
                let slope = chi.sin() * theta_o.sin() * (width / 2.0).sin().abs();
                let scale = |t: f64| f64::EPSILON * (1.0 + t) * (1.0 + 1.0 / (slope * spin));
                if found.len() == expected.len() {
                    largest(found.iter().zip(&expected).map(|(a, b)| (a - b).abs() / scale(*b)))
                } else {
                    f64::INFINITY
                }
            }
            PulseWidth::AlwaysOn => {
                kinds[1] += 1;
                let whole = train.pulses.len() == 1 && train.pulses[0].cut_at_start && train.pulses[0].cut_at_end;
                if whole && train.pulses[0].duration() == SPAN.1 { 0.0 } else { f64::INFINITY }
            }
            PulseWidth::NeverOn => {
                kinds[2] += 1;
                if train.pulses.is_empty() { 0.0 } else { f64::INFINITY }
            }
        };
        worst.see(figure, || format!("case {case} of seed 53: chi = {chi}, theta_o = {theta_o}, rho = {rho}, {spin}"));
    }
    if kinds.contains(&0) {
        return Err(format!("a kind was never met: {kinds:?}"));
    }
    worst.finish()
}

fn grazing_by_construction() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for_random_cases(46, 60, |case| {
        for index in 0..100 {
            // An extremum by bisection of the rate.
            let (mut low, mut high) = (0.2 * f64::from(index), 0.2 * f64::from(index + 1));
            let rising = case.margin(low)[1] > 0.0;
            if (case.margin(high)[1] > 0.0) == rising {
                continue;
            }
            for _ in 0..60 {
                let middle = (low + high) / 2.0;
                if (case.margin(middle)[1] > 0.0) == rising { low = middle } else { high = middle }
            }
            let [margin, _, second] = case.margin(low);
            let product = margin + case.beam.half_opening.cos();
            // A flat extremum, or a beam whose cosine rounds its angle, makes another test.
            if second.abs() < 1e-2 || product.abs() > 0.95 {
                continue;
            }
            let with_offset = |offset: f64| {
                let beam = Beam { half_opening: (product + offset).acos(), ..case.beam };
                let span = ((low - 0.05).max(SPAN.0), (low + 0.05).min(SPAN.1));
                pulse_train(&case.motion, &beam, &case.observer, span).map_err(|e| e.to_string())
            };
            let touching = with_offset(0.0)?;
            let mut figure = if touching.grazings.iter().any(|t| (t - low).abs() < 1e-5) { 0.0 } else { f64::INFINITY };
            for size in [1e-10, 1e-11, 1e-12] {
                for offset in [size, -size] {
                    let found = edges(&with_offset(offset)?);
                    // Edges near the extremum: two where cos rho is on the side of the extremum's curvature.
                    let near: Vec<f64> = found.into_iter().filter(|t| (t - low).abs() < 1e-3).collect();
                    let crossing = (offset > 0.0) == (second > 0.0);
                    figure = match (crossing, near.as_slice()) {
                        (true, [start, end]) => {
                            let expected = 2.0 * (2.0 * size / second.abs()).sqrt();
                            largest([figure, ((end - start) / expected - 1.0).abs()])
                        }
                        (false, []) => figure,
                        _ => f64::INFINITY,
                    };
                }
            }
            worst.see(figure, || format!("extremum {margin} at {low}, {}", case.name));
        }
        Ok(())
    })?;
    worst.finish()
}

fn symmetries() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for_random_cases(47, 100, |case| {
        let whole = case.train()?;
        let supplement = Beam { half_opening: PI - case.beam.half_opening, ..case.beam.opposite() };
        let message = |e: Error| format!("{}: {e}", case.name);
        let between = pulse_train(&case.motion, &supplement, &case.observer, SPAN).map_err(message)?;
        let part_span = (13.7, 4.3);
        let part = pulse_train(&case.motion, &case.beam, &case.observer, part_span).map_err(message)?;
        let within: Vec<f64> = edges(&whole).into_iter().filter(|t| (4.3..=13.7).contains(t)).collect();
        let compare = |a: &[f64], b: &[f64]| {
            if a.len() != b.len() {
                return f64::INFINITY;
            }
            // An edge is as uncertain as m.n is over its slope.
            largest(a.iter().zip(b).map(|(x, y)| (x - y).abs() * case.margin(*x)[1].abs().min(1.0)))
        };
        let figure = largest([compare(&edges(&whole), &edges(&between)), compare(&within, &edges(&part))]);
        let cut = part.pulses.iter().all(|p| p.cut_at_start == (p.start == 4.3) && p.cut_at_end == (p.end == 13.7));
        worst.see(if cut { figure } else { f64::INFINITY }, || case.name.clone());
        Ok(())
    })?;
    worst.finish()
}

/// The motion, beam and observer of the paper's pulsar signals.
pub(super) struct Signal {
    pub(super) motion: TaylorMotion<f64>,
    pub(super) beam: Beam<f64>,
    pub(super) observer: Vector3<f64>,
}

/// The signal of an example, over 400 t_c.
pub(super) fn paper_signal(name: &str) -> Result<Signal, Error> {
    let reference = reference_motion(name);
    signal_from(&reference, &reference.initial())
}

fn signal_from(reference: &ReferenceMotion, start: &BodyState<f64>) -> Result<Signal, Error> {
    let motion = propagate(&reference.spheroid, &reference.violation(), start, (0.0, 400.0), 1e-14)?;
    let theta_o: f64 = 0.8;
    let observer = Vector3::new(theta_o.sin(), 0.0, theta_o.cos());
    Ok(Signal { motion, beam: Beam::new(0.5, 0.0, 0.6), observer })
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
    let rounded = BodyState::from_angles(&reference.spheroid, &angles, &rates);
    let train = |start: &BodyState<f64>| {
        let Signal { motion, beam, observer } = signal_from(&reference, start).map_err(|e| e.to_string())?;
        let at_start = beam.direction(start).dot(&observer);
        pulse_train(&motion, &beam, &observer, (0.0, 400.0)).map(|train| (train, at_start)).map_err(|e| e.to_string())
    };
    let (exact, at_start) = train(&reference.initial())?;
    let (rounded, _) = train(&rounded)?;
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
