//! A pulsar as a clock over decades: numbers and arrival times. Eqs. (44), (47).

use twofold::observables::pulsar::PulsarClock;
use twofold::propagation::PhasedMotion;
use twofold::solutions::averaged::OfRotations;

use crate::prelude::*;
use twofold_scene::pulsar_timing::PulsarScene;
use twofold_scene::scene_file::PULSARS;

checks! {
    /// numbers and midpoints of single pulses, looked up in any order over 2000 t_c of an averaged motion, agree with the pulse train, whose
    /// turns are followed in steps of half a radian: chi less or more than the wobble and its supplement, spins of both signs, L that circles the
    /// line of sight or not
    Oracle "pulsar-clock-numbers" [44]: || numbers(averaged, PhasedMotion::averaged);
    AtMost(1e-6) "largest error of a midpoint [t_c]; infinite if a number is wrong, 40 random pulsars of 10 pulses or more";
    because "the last step to an edge, some 1e-4 rad, is by derivatives of the exact motion, off by (C |s| I^xx / |L|^2)^2, up to 7e-4; a margin is \
     slow at the edges of a short pulse";
    /// the same for the exact motion: the clock on the torus, the pulse train by Taylor series
    Oracle "pulsar-clock-torus" [44]: || numbers(taylor, |problem| PhasedMotion::torus(problem, 2000.0));
    AtMost(1e-11) "largest error of a midpoint [t_c]; infinite if a number is wrong, 40 random pulsars of 10 pulses or more";
    because "the Taylor series loses 2e-16 for each radian, 1e-12 in all; the margin of a short pulse is slower at its edges by ten at most";
    /// at late times, without following the turns up to them, numbers and midpoints agree with the pulse train by Taylor series from the state there:
    /// the four examples of strong violation
    Oracle "pulsar-clock-late" [44]: late;
    AtMost(1e-11) "largest error of a midpoint from the time [t_c], 1e6, 1e9 and 1e12 t_c, 300 t_c each; infinite if a number is wrong";
    because "the state is exact to 1e-15, and the Taylor series to 2e-16 for each radian, 1e-13 in all; the margin of a short pulse is slower at its edges";
    /// the number of turns in a gap of any length is that of the mean rate of m about L: nu', plus l' where L does not
    /// circle the line of sight, and plus psi' where m is farther from n than L is: the four examples
    Oracle "pulsar-clock-gaps" [44]: gaps;
    AtMost(1.0) "largest difference of the number of a pulse from its time over the mean period, that of the first pulse taken away [turns], 1e6, 1e9, 1e12 t_c";
    because "the azimuth of m about L is at most half a turn from that of its mean turns either way, and the fundamental frequencies are right to 1e-16: \
     1e-4 of a turn";
    /// for weakly perturbed stars the clocks on the torus and on the averaged motion agree within the error that the latter states: tp-II with its
    /// tensor times 0.1, 0.01, 0.001, over 1e5 t_c
    Oracle "pulsar-clock-averaged" [44]: against_averaged;
    AtMost(1.0) "largest difference of a midpoint over the estimated error of the averaged one";
    because "the estimate is that of directions, of which the middle of two edges takes a part";
    /// arrival times of the four built-in pulsars 20 years before and after their epochs, with their coefficients and with |s| of 1e-9, are those
    /// of the same averaged motion in double-double arithmetic
    Oracle "pulsar-clock-20-years" [44]: twenty_years;
    AtMost(1e-13) "largest difference of a midpoint [s], 401 epochs each, those without a pulse left out";
    because "directions are rounded to 1e-15 rad, at the edges of a pulse of 3 degrees 40 times that, and a radian is 65 ms at most: 3e-15 s of one rounding";
    /// without Lorentz violation the residuals of B1828-11 follow from the azimuth of the magnetic axis about L: P (gamma - D) / (2 pi), tan D =
    /// sin chi sin gamma / (cos chi sin theta + sin chi cos theta cos gamma)
    Oracle "pulsar-clock-free-precession" [44, 48]: free_precession;
    AtMost(5e-11) "largest difference of arrival and formula, the best epoch and frequency taken away [s], 500 pulses over 10 years";
    because "arrival times are rounded to 9e-12 s, and the residual to as much; at epsilon = 9e-9 what the formula leaves out (next check) is 1e-12 \
     s";
    /// the remainder of that formula is of first order in epsilon: a midpoint is not the closest approach, since the angle theta_m of the
    /// magnetic axis to L changes between both edges and shifts it by theta_m' sin(zeta - theta_m) / (sin zeta sin theta_m phi'^2), zeta the
    /// angle of the line of sight to L
    Oracle "pulsar-clock-free-precession-order" [44, 48]:
        || order_of_error(&[1e-6, 1e-5, 1e-4, 1e-3], |epsilon| left_of_formula(Some(epsilon)).map(|[left, _]| left));
    Within(0.95, 1.05) "slope of the largest difference over epsilon, 1e-6 to 1e-3, the wobble and the rotation of B1828-11";
    because "theta_m' is the wobble angle times epsilon Omega^z";
}

fn any_direction(random: &mut Random) -> Vector3<f64> {
    let (z, azimuth) = (random.within(-0.98, 0.98), random.within(-PI, PI));
    let across = f64::sqrt(1.0 - z * z);
    Vector3::new(across * azimuth.cos(), across * azimuth.sin(), z)
}

fn any_star(random: &mut Random) -> Result<Problem<f64>, String> {
    let axis = any_direction(random);
    let size = random.within(1.5, 3.0);
    let momentum = any_direction(random) * size;
    let equatorial_axis = axis.cross(&any_direction(random)).normalize();
    let s = PrincipalCoefficients::new([0; 3].map(|_| random.within(-0.03, 0.03))).tensor();
    let spheroid = RigidSpheroid::in_units_of_tc(random.within(0.6, 1.6));
    Ok(Problem::new(spheroid, s, BodyState { axis, momentum, equatorial_axis })?)
}

fn averaged(problem: &Problem<f64>) -> Result<AveragedMotion<f64>, Error> {
    AveragedMotion::new(problem, (0.0, 2000.0))
}

fn taylor(problem: &Problem<f64>) -> Result<TaylorMotion<f64>, Error> {
    problem.taylor((0.0, 2000.0), 1e-13)
}

/// Compared for random stars.
fn numbers<M: Motion<f64, State = BodyState<f64>>>(
    motion: impl Fn(&Problem<f64>) -> Result<M, Error>,
    phased: impl Fn(&Problem<f64>) -> Result<PhasedMotion, Error>,
) -> Result<Measured, String> {
    let (mut random, mut worst, mut stars, mut tried) = (Random::with_seed(91), Worst::default(), 0, 0);
    while stars < 40 {
        tried += 1;
        if tried > 4000 {
            return Err(format!("only {stars} of {tried} random pulsars have ten pulses to look up"));
        }
        let problem = any_star(&mut random)?;
        let beam = Beam::new(random.within(0.05, PI - 0.05), random.within(-PI, PI), random.within(0.1, 0.9));
        let observer = Observer::at(random.within(0.05, PI - 0.05), random.within(-PI, PI));
        let Ok(clock) = phased(&problem).and_then(|phased| PulsarClock::new(phased, &beam, &observer)) else {
            continue;
        };
        let motion = motion(&problem)?;
        let n = &observer.direction;
        let train = pulse_train(&motion, &beam, n, motion.span())?;
        let Ok(found) = arrivals(&motion, &beam, n, &train) else { continue };
        let whole: Vec<_> = train.pulses.iter().filter(|pulse| pulse.is_whole()).collect();
        // Pulses that are alone in their turn and shorter than half of it.
        let alone = |i: usize| {
            let differs = |j: Option<&Arrival>| j.is_none_or(|j| j.number != found[i].number);
            differs(i.checked_sub(1).and_then(|j| found.get(j)))
                && differs(found.get(i + 1))
                && whole[i].duration() < 1.0
        };
        let mut single: Vec<_> = (0..found.len()).filter(|&i| alone(i)).collect();
        if single.len() < 10 {
            continue;
        }
        stars += 1;
        let mut offset = None;
        for _ in 0..30.min(single.len()) {
            let i = single.swap_remove((random.word() % single.len() as u64) as usize);
            let near = found[i].midpoint + random.within(-0.3, 0.3) * clock.period();
            let pulse = clock.pulse_near([near, 0.0])?;
            let place = || format!("pulsar {tried} of seed 91 at t = {}", found[i].midpoint);
            let Some(pulse) = pulse else {
                worst.see(f64::INFINITY, || format!("no pulse: {}", place()));
                continue;
            };
            let expected = *offset.get_or_insert(pulse.number - found[i].number) + found[i].number;
            let error = (pulse.midpoint[0] - found[i].midpoint) + pulse.midpoint[1];
            let figure = if pulse.number == expected { error.abs() } else { f64::INFINITY };
            worst.see(figure, || format!("{}: {error:e}, number {} for {expected}", place(), pulse.number));
        }
    }
    worst.finish()
}

/// Name, star, clock of the motion on the torus.
type Example = (&'static str, Problem<f64>, PulsarClock);

/// The four examples of strong violation.
fn examples() -> Result<Vec<Example>, String> {
    let of = |name: &'static str| {
        let problem = Scene::named(name)?.problem;
        let clock = PulsarClock::new(PhasedMotion::torus(&problem, 1e12)?, &beam(), &observer())?;
        Ok((name, problem, clock))
    };
    ["tp-1", "tp-2", "sp-1", "sp-2"].into_iter().map(of).collect()
}

fn beam() -> Beam<f64> {
    Beam::new(0.9, 0.3, 0.5)
}

fn observer() -> Observer<f64> {
    Observer::at(1.0, 0.2)
}

fn late() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for (name, problem, clock) in examples()? {
        for late in [1e6, 1e9, 1e12] {
            let motion = problem.starting_from(clock.near([late, 0.0])(0.0)?)?.taylor((0.0, 300.0), 1e-14)?;
            let direction = observer().direction;
            let train = pulse_train(&motion, &beam(), &direction, motion.span())?;
            let found = arrivals(&motion, &beam(), &direction, &train)?;
            let mut offset = None;
            for arrival in &found {
                let pulse = clock.pulse_near([late, arrival.midpoint])?.ok_or("no pulse")?;
                let error = (pulse.midpoint[0] - late) + pulse.midpoint[1] - arrival.midpoint;
                let is_next = pulse.number - arrival.number == *offset.get_or_insert(pulse.number - arrival.number);
                let figure = if is_next { error.abs() } else { f64::INFINITY };
                worst.see(figure, || format!("{name} at {late:e} + {}: turn {}", arrival.midpoint, pulse.number));
            }
        }
    }
    worst.finish()
}

fn gaps() -> Result<Measured, String> {
    let mut worst = Worst::default();
    for (name, problem, clock) in examples()? {
        let exact = QuasiPeriodicMotion::new(&problem)?;
        let rate = |symbol| exact.frequencies().rate(symbol).ok_or_else(|| format!("{name} has no {symbol}"));
        // Turns are counted from the line of sight. If L circles it, it turns with the plane of L and the axis.
        let (momentum, pole) = (problem.initial().momentum, exact.frequencies().pole);
        let side = momentum.dot(&pole).signum();
        let goes_round = observer().direction.angle(&(pole * side)) < momentum.angle(&(pole * side));
        let about_momentum = rate("nu'")? + if goes_round { 0.0 } else { side * rate("l'")? };
        // The beam is at 0.9 rad from n.
        let is_beyond = 0.9 > problem.initial().axis.angle(&momentum);
        let period = TAU / (about_momentum + if is_beyond { rate("psi'")? } else { 0.0 });
        let turns = |late: f64| -> Result<f64, String> {
            let mut tries = (0..1000).map(|k| clock.pulse_near([late, f64::from(k) * clock.period()]));
            let pulse = tries.find_map(Result::transpose).ok_or("no pulse")??;
            // Number minus turns of the mean rate, in 32 digits.
            let time = DoubleDouble::sum_of(pulse.midpoint[0], pulse.midpoint[1]);
            let number = DoubleDouble::from_f64(pulse.number as f64);
            Ok((number - time / DoubleDouble::from_f64(period)).high())
        };
        let first = turns(0.0)?;
        for late in [1e6, -1e6, 1e9, 1e12] {
            worst.see((turns(late)? - first).abs(), || format!("{name} at {late:e}"));
        }
    }
    worst.finish()
}

fn against_averaged() -> Result<Measured, String> {
    let (mut worst, mut compared) = (Worst::default(), 0);
    let strong = Scene::named("tp-2")?.problem;
    for scale in [0.1, 0.01, 0.001] {
        let problem = Problem::new(*strong.spheroid(), strong.coefficients() * scale, *strong.initial())?;
        let averaged = PulsarClock::new(PhasedMotion::averaged(&problem)?, &beam(), &observer())?;
        let torus = PulsarClock::new(PhasedMotion::torus(&problem, 1e5)?, &beam(), &observer())?;
        for k in -200..=200 {
            let t = 500.0 * f64::from(k);
            let (a, b) = match (averaged.pulse_near([t, 0.0])?, torus.pulse_near([t, 0.0])?) {
                (Some(a), Some(b)) => (a, b),
                (None, None) => continue,
                one => {
                    worst.see(f64::INFINITY, || format!("tensor times {scale} at {t}: a pulse of one alone, {one:?}"));
                    continue;
                }
            };
            compared += 1;
            let difference = (a.midpoint[0] - b.midpoint[0]) + (a.midpoint[1] - b.midpoint[1]);
            let figure = if a.number == b.number { difference.abs() / averaged.truncation(t) } else { f64::INFINITY };
            worst.see(figure, || format!("tensor times {scale} at {t}: {difference:e}"));
        }
    }
    if compared < 600 {
        return Err(format!("only {compared} pulses were compared"));
    }
    worst.finish()
}

/// The same averaged motion in 31 digits.
struct Exact {
    mean: AveragedSolution<DoubleDouble>,
    rates: OfRotations<DoubleDouble>,
    start: OfRotations<DoubleDouble>,
    beam: Beam<DoubleDouble>,
    line_of_sight: Vector3<DoubleDouble>,
    turn: DoubleDouble,
}

impl Exact {
    fn of(pulsar: &PulsarScene, beam: &Beam<f64>) -> Result<Self, String> {
        let number = DoubleDouble::from_f64;
        let given = &pulsar.problem;
        let frame = principal_frame(given.coefficients())?;
        let turned = given.rotated(&frame.principal_from_given).map(number);
        let c = frame.coefficients;
        let s = PrincipalCoefficients::new([c.xx, c.yy, c.zz].map(number));
        let start = *given.map(number).initial();
        let turned = Problem::new(*turned.spheroid(), s.tensor(), *turned.initial())?.with_bulge(turned.bulge())?;
        let mean = AveragedSolution::with_free_rotation_of(&start, &turned, AveragingOrder::Second)?;
        Ok(Self {
            rates: mean.rates(),
            start: mean.phases_at([0.0; 2]),
            mean,
            beam: Beam { axis: beam.axis.map(number), half_opening: number(beam.half_opening) },
            line_of_sight: pulsar.observer.rotated(&frame.principal_from_given).direction.map(number),
            turn: DoubleDouble::tau(),
        })
    }

    fn margin(&self, t: DoubleDouble) -> DoubleDouble {
        let Self { rates, start, .. } = self;
        let phase = |start: DoubleDouble, rate: DoubleDouble| {
            let whole = start + rate * t;
            let turns = (whole / self.turn).high().round();
            whole - self.turn * DoubleDouble::from_f64(turns)
        };
        let phases = OfRotations {
            slow: phase(start.slow, rates.slow),
            about_momentum: phase(start.about_momentum, rates.about_momentum),
            about_axis: phase(start.about_axis, rates.about_axis),
        };
        self.beam.margin(&self.mean.state_at(&phases), &self.line_of_sight)
    }

    /// The edge near a time, by the secant method.
    fn edge(&self, near: DoubleDouble, width: f64) -> DoubleDouble {
        let mut points = [near, near + DoubleDouble::from_f64(1e-6 * width)];
        for _ in 0..8 {
            let [a, b] = points.map(|t| self.margin(t));
            if (b - a).is_zero() {
                break;
            }
            points = [points[1], points[1] - b * (points[1] - points[0]) / (b - a)];
        }
        points[1]
    }
}

/// The built-in pulsars with another `alpha_2`, without slowing down.
fn pulsars(alpha_2: &str) -> Result<Vec<(String, Scene)>, String> {
    let scene = |built_in: &twofold_scene::scene_file::BuiltIn| {
        let text = built_in.toml.replace("alpha_2 = 1.6e-9", &format!("alpha_2 = {alpha_2}"));
        let name = format!("{} with alpha_2 = {alpha_2}", built_in.name);
        let scene = Scene::from_toml(&name, &text)?;
        Ok((name, Scene { spin_down: None, ..scene }))
    };
    PULSARS.iter().map(scene).collect()
}

fn twenty_years() -> Result<Measured, String> {
    // |w|^2 alpha_2 = 1e-9.
    let pulsars = [pulsars("1.6e-9")?, pulsars("6.6e-4")?].concat();
    worst_of(0..pulsars.len(), |&i| {
        let (name, scene) = &pulsars[i];
        let pulsar = PulsarScene::new(scene)?;
        let beam = scene.pulsar.ok_or("no beam")?.beam();
        let exact = Exact::of(&pulsar, &beam)?;
        let (mut worst, mut seen) = (0.0, 0);
        for k in 0..=400 {
            let t = [f64::from(k - 200) * (0.1 * 31_557_600.0), 1.7e-10];
            // With |s| = 1e-9 the beam of a millisecond pulsar turns out of the line of sight and back.
            let Some(pulse) = pulsar.clock.pulse_near(t)? else { continue };
            seen += 1;
            let middle = DoubleDouble::sum_of(pulse.midpoint[0], pulse.midpoint[1]);
            let half = DoubleDouble::from_f64(pulse.duration / 2.0);
            let edges = [middle - half, middle + half].map(|edge| exact.edge(edge, pulse.duration));
            let expected = (edges[0] + edges[1]) / DoubleDouble::from_f64(2.0);
            worst = largest([worst, (middle - expected).high().abs()]);
        }
        Ok(Measured::new(if seen < 20 { f64::INFINITY } else { worst }, format!("{name}: {seen} pulses in 401 epochs")))
    })
}

fn free_precession() -> Result<Measured, String> {
    let [left, size] = left_of_formula(None)?;
    Ok(Measured::new(left, format!("residuals up to {size:.2e} s")))
}

/// B1828-11 without Lorentz violation, with its own or another `epsilon` at the same rotation about `L`.
fn free_b1828(epsilon: Option<f64>) -> Result<Scene, String> {
    let (name, scene) =
        pulsars("0.0")?.into_iter().find(|(name, _)| name.starts_with("b1828-11")).ok_or("no such scene")?;
    let Some(epsilon) = epsilon else { return Ok(scene) };
    // alpha' cos(beta) = (1 + epsilon) Omega^z.
    let rate = scene.problem.initial().momentum.norm() / scene.problem.spheroid().inertia_xx / scene.units.time;
    let along = rate * scene.initial_angles.beta.cos();
    let spin = along / (1.0 + epsilon) / (2.0 * PI);
    let toml = PULSARS.iter().find(|scene| name.starts_with(scene.name)).ok_or("no such scene")?.toml;
    let lines = toml.lines().map(|line| match line.split_once(" = ") {
        Some(("alpha_2", _)) => "alpha_2 = 0.0".to_owned(),
        Some(("precession_period", _)) => format!("oblateness = {epsilon:?}"),
        Some(("frequency", _)) => format!("spin_frequency = {spin:?}"),
        _ => line.to_owned(),
    });
    let text = lines.collect::<Vec<_>>().join("\n");
    Ok(Scene { spin_down: None, ..Scene::from_toml(&name, &text)? })
}

/// Largest difference of the residuals of free precession from the formula, and the largest residual.
fn left_of_formula(epsilon: Option<f64>) -> Result<[f64; 2], String> {
    let scene = free_b1828(epsilon)?;
    let pulsar = PulsarScene::new(&scene)?;
    let (chi, theta) = (scene.pulsar.ok_or("no beam")?.chi, scene.initial_angles.beta);
    let epochs = (0..500).map(|k| pulsar.epoch.after([f64::from(k) * 631_152.0, 0.0]));
    let epochs = epochs.collect::<Result<Vec<_>, _>>()?;
    let timing = pulsar.timed(&epochs, 0)?;
    let period = 1.0 / timing.fit.frequency[0];
    // The azimuth about L, gamma + (D - gamma), is that of the line of sight: a pulse is late if D is behind gamma.
    let late = |state: &BodyState<f64>| {
        let l = state.momentum.normalize();
        let m = scene.pulsar.map(|p| p.beam().direction(state)).unwrap_or_default();
        let (n, phi) = (state.axis, l.cross(&state.axis).normalize());
        let theta_hat = phi.cross(&n);
        let (sin, cos) = (m.dot(&phi) / chi.sin(), m.dot(&theta_hat) / chi.sin());
        let d = (chi.sin() * sin).atan2(chi.cos() * theta.sin() + chi.sin() * theta.cos() * cos);
        let behind = sin.atan2(cos) - d;
        period * (behind - (behind / (2.0 * PI)).round() * 2.0 * PI) / (2.0 * PI)
    };
    // The remainder of the difference without its mean and its slope.
    let left = timing.pulses.iter().zip(&timing.fit.residuals);
    let left = left.map(|(timed, residual)| (timed.pulse.number, residual - late(&timed.pulse.state)));
    let fit = ConstantPeriod::fit(&left.collect::<Vec<_>>(), None)?;
    let size = largest(timing.fit.residuals.iter().map(|r| r.abs()));
    Ok([largest(fit.residuals.iter().map(|r| r.abs())), size])
}
