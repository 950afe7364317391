//! The motion as a Fourier series on its torus: each step of its derivation, and its states.

use super::plans::{derivatives, largest_part, turned};
use crate::independent_taylor::state_after;
use crate::prelude::*;
use twofold::propagation::TorusMotion;
use twofold::solutions::torus::TorusSolution;

checks! {
    /// a motion reflected in a principal plane of s^IJ, with n and L as vectors, is a motion in -t
    Property "torus-reflection" [25]: reflection;
    AtMost(1e-11) "largest difference of a component, 50 random motions over 20 units of time, each plane, by two integrators";
    because "two integrations of some 40 rad at the tolerance 1e-13, whose estimated errors add to some 5e-12";
    /// energy, Omega^z, K and |n| are the same at every point of the torus, and n.e_x is zero there
    Property "torus-integrals" [24, 25]: integrals;
    AtMost(1e-13) "largest difference / size of the terms, 60 random tori at 50 random points";
    because "each coefficient is rounded by 2e-16 of the largest, some 300 are summed, and K is of third degree: 1e-14 as a random walk";
    /// the series solves the equations of motion: its derivative along the three rates is that of n, L and e_x
    Property "torus-equations" [25]: equations;
    AtMost(1e-9) "largest residual / rate of rotation, 60 random tori at 20 random points";
    because "central differences of the sixth order in steps of 0.003 turns of the fastest angle, 0.02 rad, divide the rounding 1e-15 by 0.02, and leave \
     (0.02 k)^6 / 140 of a term of order k: 7e-9 of one of fifth order, which is below a tenth";
    /// the series reproduces n, L and e_x of a 34-digit integration, at every listed time
    Oracle "torus-reference" [25, 57]: against_reference;
    AtMost(1e-13) "largest error of a component, scenes with anisotropic s";
    because "the initial values of the references are decimal numbers, rounded by 1e-16, which grows with a phase of 600 rad to 6e-14";
    /// the series reproduces the motion in double-double numbers over 1,000 t_c: the four examples, s = diag(0.3, 0.1, -0.4), and L 1e-4 rad from the
    /// middle axis
    Oracle "torus-thousand" [25, 57]: thousand;
    AtMost(1e-13) "largest error of a component";
    because "the phases have 32 digits; coefficients and their sum are rounded by 2e-16 each, which passing the middle axis at 1e-4 rad multiplies by at most \
     1e2";
    /// the estimated error of the series is not below the true one
    Oracle "torus-error-estimate" [25]: estimates;
    AtMost(1.0) "largest true / estimated error, 200 random scenes up to 60 rad, and eight that are near an edge";
    because "an estimate below the true error is wrong";
    /// at any strength of the torque, also from rest, hardly any motion is refused unless L starts beside the middle axis
    Property "torus-refusals" [25]: refusals;
    AtMost(0.01) "share of 400 random scenes";
    because "only tori within rounding of the separatrix are refused, which random starts seldom hit";
    /// derivatives of n, L and e_x with respect to fifteen parameters, by the period lattice of the torus, agree with duals through Taylor series
    /// over 200 t_c: the four examples, s = diag(0.3, 0.1, -0.4), diag(0.02, 0.02, -0.04) and diag(2e-7, 1e-7, -3e-7), and at least 20 random scenes
    /// in any frame
    Oracle "torus-gradient" [25]: gradient_by_series;
    AtMost(1e-11) "largest difference / largest derivative by the same parameter at the same time (at least 1e-3)";
    because "some 400 steps of the series, each rounded by 1e-16, in a phase of 400 rad: 400 x 400 x 1e-16 = 2e-11 if all add up, 1e-12 as a random walk; the periods of the torus, of which 70 are passed, have a rounding of 1e-15 each";
    /// after 1e6 t_c the derivatives agree with finite differences for the initial state of tp-2 and s = diag(0.02, 0.01, -0.04), diag(0.3,
    /// 0.1, -0.4) and diag(0.02, 0.02, -0.04), in a rotated frame
    Oracle "torus-gradient-long" [25]: gradient_by_differences;
    AtMost(1e-8) "largest difference / largest derivative by the same parameter";
    because "means of four differences of the eighth order for changes by some 0.03 rad. The initial state of a changed motion is rounded by 1e-16, which is 1e-10 rad after 1e6 rad, over 0.03 rad and by \
     the sum of weights 1.9: 6e-9, half of that in the mean; terms of fifth order in the angles leave 0.15^8 / 630 of them, 1e-9 of such terms of 1e-3";
}

/// Parameters of a problem whose axis is not at a pole.
fn parameters(problem: &Problem<f64>) -> Result<Parameters<f64>, Error> {
    let (spheroid, initial) = (problem.spheroid(), problem.initial());
    Ok(Parameters::new(*spheroid, *problem.coefficients(), initial.angles()?, initial.rates(spheroid)?))
}

/// The four examples.
fn examples() -> Result<Vec<Parameters<f64>>, Error> {
    ["tp-1", "tp-2", "sp-1", "sp-2"].into_iter().map(|name| parameters(&reference_motion(name).problem())).collect()
}

fn with_tensor(start: &Parameters<f64>, values: [f64; 3]) -> Parameters<f64> {
    Parameters { coefficients: PrincipalCoefficients::new(values).tensor(), ..*start }
}

fn gradient_by_series() -> Result<Measured, String> {
    let times = [200.0, 77.0];
    let both_ways = |start: &Parameters<f64>| -> Result<f64, Error> {
        let torus = derivatives(start, Some(Method::Torus), 1e-15, &times)?;
        Ok(largest_part(&torus, &derivatives(start, Some(Method::Taylor), 1e-16, &times)?))
    };
    let mut named = examples()?;
    let tensors = [[0.3, 0.1, -0.4], [0.02, 0.02, -0.04], [2e-7, 1e-7, -3e-7]];
    named.extend(tensors.map(|values| with_tensor(&named[1], values)));
    let of_named = worst_of(&named, |start| Ok(both_ways(start)?))?;
    let mut compared = 0;
    let strategy = (crate::physical_domain::scenes(), proptest::array::uniform3(-3.0..3.0f64));
    let of_random = worst_over(65, 24, &strategy, |(scene, frame)| {
        let coefficients = *turned(&scene.problem(), *frame).coefficients();
        let start = Parameters::new(scene.spheroid, coefficients, scene.angles, scene.rates);
        // Scenes that turn slowly compared with the torque may have no such torus.
        let Ok(_) = TorusSolution::new(&start.problem()?, 1e-15, 200.0) else { return Ok(None) };
        compared += 1;
        Ok(Some(both_ways(&start)?))
    })?;
    if compared < 20 {
        return Err(format!("only {compared} of 24 random scenes have a torus"));
    }
    Ok(if of_named.figure > of_random.figure { of_named } else { of_random })
}

fn gradient_by_differences() -> Result<Measured, String> {
    const T: f64 = 1e6;
    const STEPS: [f64; 4] = [0.025, 0.0275, 0.03, 0.0325];
    const WEIGHTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    // In this frame every parameter but gamma changes phases in proportion to time.
    let frame = Rotation3::from_euler_angles(0.4, -0.7, 1.1);
    let tp = &examples()?[1];
    worst_of([[0.02, 0.01, -0.04], [0.3, 0.1, -0.4], [0.02, 0.02, -0.04]], |values| {
        let start = with_tensor(tp, *values);
        let start = Parameters { coefficients: frame * start.coefficients * frame.transpose(), ..start };
        let found = derivatives(&start, Some(Method::Torus), 1e-15, &[T])?;
        worst_of(Parameter::OF_MOTION.into_iter().enumerate(), |&(i, parameter)| {
            let column = found.jacobians[0].column(i);
            let size = column.amax();
            let state = |change: f64| -> Result<_, Error> {
                let changed = start.moved(&[parameter], &[change]);
                let vectors = TorusMotion::new(&changed.problem()?, (0.0, T), 1e-15)?.state(T)?.vectors();
                Ok(DMatrix::from_iterator(9, 1, vectors.iter().flatten().copied()))
            };
            let mut difference = DMatrix::zeros(9, 1);
            for step in STEPS.map(|step| step / size) {
                for (k, weight) in WEIGHTS.into_iter().enumerate() {
                    let change = (k + 1) as f64 * step;
                    difference += (state(change)? - state(-change)?) * (weight / step / STEPS.len() as f64);
                }
            }
            Ok(largest_component(&(difference - column)) / size)
        })
    })
}

/// Tori of random motions with two strengths, accurate to rounding.
fn tori(
    seed: u64,
    figure: impl Fn(&Problem<f64>, &TorusSolution, &mut Random) -> Result<f64, String>,
) -> Result<Measured, String> {
    let mut case = 0;
    worst_of_draws(seed, 60, |random| {
        case += 1;
        let problem = loop {
            let scene = super::frequencies::scenes::Scene::random(random, case, [0.003, 0.1][case % 2]);
            if scene.complement() >= 0.05 {
                break scene.problem()?;
            }
        };
        figure(&problem, &TorusSolution::new(&problem, 1e-15, 1.0)?, random)
    })
}

fn reflection() -> Result<Measured, String> {
    worst_over(61, 50, &crate::physical_domain::scenes(), |scene| {
        let problem = scene.problem();
        let principal = problem.rotated(&principal_frame(problem.coefficients())?.principal_from_given);
        let motion = principal.reduced().taylor((0.0, 20.0), 1e-13)?;
        worst_of(0..3, |&plane| {
            let reflected = |v: Vector3<f64>| Vector3::from_fn(|i, _| if i == plane { -v[i] } else { v[i] });
            let back =
                principal.starting_from(BodyState::from_vectors(principal.initial().vectors().map(reflected)))?;
            let size = principal.initial().momentum.norm().max(1.0);
            worst_of([3.1, 20.0], |&t| {
                let AxisState { axis, momentum } = motion.state(t)?;
                let there = AxisState { axis: reflected(axis), momentum: reflected(momentum) };
                // The same integrator would take the same steps with the same bits.
                Ok(largest_difference(&there, &state_after(&back, -t, 1e-13).axis_state(), size))
            })
        })
    })
}

fn integrals() -> Result<Measured, String> {
    tori(62, |problem, solution, random| {
        let (body, s) = (problem.spheroid(), problem.coefficients());
        let of = |state: &BodyState<f64>| first_integrals(body, s, state);
        let start = of(problem.initial());
        let size = problem.initial().momentum.norm_squared();
        worst_of(0..50, |_| {
            let at = solution.state_on_torus([0, 1, 2].map(|_| random.within(0.0, 1.0)));
            let found = of(&at);
            Ok(largest([
                (found.energy - start.energy).abs() / (size / body.inertia_xx + body.constant_c * s.amax()),
                (found.spin - start.spin).abs() * body.inertia_xx / size.sqrt(),
                (found.clebsch - start.clebsch).abs() / (size * s.amax()),
                (at.axis.norm() - 1.0).abs(),
                at.axis.dot(&at.equatorial_axis).abs(),
            ]))
        })
        .map(|measured: Measured| measured.figure)
    })
}

fn equations() -> Result<Measured, String> {
    tori(63, |problem, solution, random| {
        let rates = solution.rates();
        let rotation = problem.initial().momentum.norm() / problem.spheroid().inertia_xx;
        worst_of(0..20, |_| {
            let turns = [0, 1, 2].map(|_| random.within(0.0, 1.0));
            let step = 0.003 * TAU / rates.iter().fold(0.0, |most: f64, rate| most.max(rate.abs()));
            let at = |k: f64| solution.state_on_torus([0, 1, 2].map(|i| turns[i] + k * step * rates[i] / TAU));
            // (45 (f_1 - f_-1) - 9 (f_2 - f_-2) + (f_3 - f_-3)) / 60.
            let sides = [1.0, 2.0, 3.0].map(|k| [at(k), at(-k)].map(|state| state.vectors()));
            let here = at(0.0);
            let exact = body_state_rates(problem.spheroid(), problem.coefficients(), &here).vectors();
            let size = [1.0, problem.initial().momentum.norm(), 1.0];
            Ok(largest((0..3).map(|i| {
                let difference = |k: usize| sides[k][0][i] - sides[k][1][i];
                let slope = (difference(0) * 45.0 - difference(1) * 9.0 + difference(2)) / (60.0 * step);
                largest_component(&(slope - exact[i])) / size[i] / rotation
            })))
        })
        .map(|measured: Measured| measured.figure)
    })
}

fn against_reference() -> Result<Measured, String> {
    let anisotropic = |motion: &crate::reference::ReferenceMotion| motion.violation().amax() > 0.0;
    worst_of(reference_motions().into_iter().filter(anisotropic), |reference| {
        let (last, _) = reference.states.last().ok_or("a reference without times")?;
        let motion = TorusMotion::new(&reference.problem(), (0.0, *last), 1e-15)?;
        worst_of(&reference.states, |(t, state)| Ok(largest_difference(&motion.state(*t)?, state, 1.0)))
    })
}

fn thousand() -> Result<Measured, String> {
    let example = |name: &str| reference_motion(name).problem();
    let tensor = |values: [f64; 3]| PrincipalCoefficients::new(values).tensor();
    let strong = {
        let tp = example("tp-2");
        Problem::new(*tp.spheroid(), tensor([0.3, 0.1, -0.4]), *tp.initial())?
    };
    let near_middle = {
        let tp = example("tp-2");
        let (sin, cos) = 1e-4_f64.sin_cos();
        let momentum = Vector3::new(0.0, cos, sin) * tp.initial().momentum.norm();
        Problem::new(*tp.spheroid(), *tp.coefficients(), BodyState { momentum, ..*tp.initial() })?
    };
    let scenes = [example("tp-1"), example("tp-2"), example("sp-1"), example("sp-2"), strong, near_middle];
    worst_of(scenes, |problem| {
        let motion = TorusMotion::new(problem, (0.0, 1000.0), 1e-15)?;
        let exact = state_after(problem, DoubleDouble::from_f64(1000.0), 1e-22);
        let found = motion.state(1000.0)?;
        let pairs = found.vectors().into_iter().zip(exact.vectors());
        Ok(largest(pairs.map(|(found, exact)| largest_component(&(found - exact.map(Real::re))))))
    })
}

/// Seed of the scenes.
const SEED: u64 = 64;

/// Seeds and numbers of difficult scenes for the estimate: `n` along `L` within 1e-8 rad, with whole turns on the way to the plane; nearly
/// equal eigenvalues; coefficients that grow again behind small ones.
const NEAR_AN_EDGE: [(u64, u64); 8] =
    [(21, 8767), (22, 1954), (22, 2905), (22, 7243), (23, 1420), (23, 2443), (23, 4387), (24, 7195)];

fn scenes() -> impl Iterator<Item = ErrorScene> {
    (0..).map(|number| ErrorScene::draw(SEED, number))
}

fn estimates() -> Result<Measured, String> {
    let short = scenes().filter(|scene| scene.turned() < 60.0);
    let ratio =
        |scene: ErrorScene| scene.estimated_and_true(Method::Torus).ok().map(|(estimate, error)| error / estimate);
    let ratios: Vec<f64> = short.filter_map(ratio).take(200).collect();
    let named = worst_of(NEAR_AN_EDGE, |&(seed, number)| {
        let scene = ErrorScene::draw(seed, number).for_method(Method::Torus, 0).ok_or("no such scene")?;
        let (estimate, error) = scene.estimated_and_true(Method::Torus)?;
        Ok(error / estimate)
    })?;
    let random = Measured::new(largest(ratios), format!("seed {SEED}"));
    Ok(if named.figure > random.figure { named } else { random })
}

fn refusals() -> Result<Measured, String> {
    let all: Vec<_> = scenes().filter(|scene| !scene.near_middle_axis).take(400).collect();
    let refused = all.iter().filter(|scene| TorusSolution::new(&scene.problem, 1e-9, 1.0).is_err()).count();
    Ok(Measured::new(refused as f64 / all.len() as f64, format!("{refused} of {} of seed {SEED}", all.len())))
}
