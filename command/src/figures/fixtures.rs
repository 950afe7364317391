//! Figures for the tests: those of the paper and those of some scenes, each drawn when a test first needs it.

use std::ops::Deref;
use std::sync::{Arc, LazyLock};

use super::{Figure, OF_A_SCENE, RECIPES, Recipe, Subject, examples, work_precision};
use twofold::observables::spectrum::{Combination, SpectralLine};
use twofold_bench::method::Carries;
use twofold_bench::timing::Times;
use twofold_bench::work_precision::Row;
use twofold_scene::scene_file::Scene;

/// Scenes unlike the paper's examples: other motions, one with constants, and physical stars.
const SCENES: [&str; 5] = ["prolate", "through-the-pole", "sp-2", "b1937+21", "b1828-11"];

type Lazy<T> = LazyLock<T, Box<dyn FnOnce() -> T + Send + Sync>>;

/// Motions shared by several figures.
type Motions = Arc<Lazy<Vec<Subject>>>;

fn motions(make: impl FnOnce() -> Vec<Subject> + Send + Sync + 'static) -> Motions {
    Arc::new(LazyLock::new(Box::new(make)))
}

/// A figure by name, and its drawing.
pub(crate) struct Fixture {
    pub(super) name: &'static str,
    drawing: Lazy<Figure>,
}

impl Fixture {
    fn new(name: &'static str, draw: impl FnOnce() -> Figure + Send + Sync + 'static) -> Self {
        Self { name, drawing: LazyLock::new(Box::new(draw)) }
    }

    fn of(recipe: &Recipe, motions: Motions) -> Self {
        let recipe = *recipe;
        Self::new(recipe.name, move || recipe.draw(&motions).expect("a figure"))
    }
}

impl Deref for Fixture {
    type Target = Figure;

    fn deref(&self) -> &Figure {
        &self.drawing
    }
}

/// The paper's figures and ours, in their order.
pub(crate) static OF_THE_PAPER: LazyLock<Vec<Fixture>> = LazyLock::new(|| {
    let motions = motions(|| examples().expect("motions").into());
    RECIPES.iter().map(|recipe| Fixture::of(recipe, motions.clone())).collect()
});

/// Each of [`scenes`] with its figures.
pub(super) static OF_SCENES: LazyLock<Vec<Vec<Fixture>>> = LazyLock::new(|| {
    let of_scene = |(name, scene): (&'static str, Scene)| {
        let motion = motions(move || vec![Subject::of_scene(name, &scene).expect("a motion")]);
        OF_A_SCENE.iter().map(|recipe| Fixture::of(recipe, motion.clone())).collect()
    };
    scenes().into_iter().map(of_scene).collect()
});

static WORK_PRECISION: LazyLock<Fixture> =
    LazyLock::new(|| Fixture::new("work-precision", || work_precision(&made_up_runs())));

pub(super) fn fixtures() -> impl Iterator<Item = &'static Fixture> {
    OF_THE_PAPER.iter().chain(OF_SCENES.iter().flatten()).chain([&*WORK_PRECISION])
}

/// The figures of one of [`scenes`].
pub(super) fn of_scene(name: &str) -> &'static [Fixture] {
    let place = scenes().iter().position(|(other, _)| *other == name).expect("a scene");
    &OF_SCENES[place]
}

/// The figure of the paper, or ours, of this name.
pub(super) fn figure(name: &str) -> &'static Figure {
    fixtures().find(|fixture| fixture.name == name).expect("a figure")
}

/// The scenes with their names, in the order in which their figures follow those of the paper.
pub(super) fn scenes() -> Vec<(&'static str, Scene)> {
    let built_in = SCENES.iter().map(|name| (*name, Scene::named(name).unwrap()));
    let files = [("tilted", TILTED), ("tone", TONE), ("askew", ASKEW), ("at-rest", AT_REST), ("spinless", SPINLESS)];
    built_in.chain(files.map(|(name, text)| (name, Scene::from_toml(name, text).unwrap()))).collect()
}

/// A physical star in free precession about Z, with all lines known in closed form.
const TONE: &str = r#"
star = { mass = 1.4, radius = 12.0, oblateness = 1e-3, spin_frequency = 57.0 }
lorentz_violation = { eigenvalues = [0.0, 0.0, 0.0] }
# The rate is (1 + oblateness) 2 pi 57 / cos(beta): L is along Z.
initial = { alpha = 0.4, beta = 0.3, gamma = 1.3, alpha_rate = 375.2601393880295, beta_rate = 0.0 }
observer = { theta_o = 1.1, phi_o = 0.6, distance = 2.5 }
pulsar = { chi = 0.7, delta = -0.8, rho = 0.5 }
time = { start = -3.0, span = 2.0, samples = 3 }
"#;

/// A physical star without any symmetry.
const ASKEW: &str = r#"
star = { mass = 1.4, radius = 12.0, oblateness = 1e-3, spin_frequency = -57.0 }
lorentz_violation.tensor = [[2e-5, 1.1e-5, -0.7e-5], [1.1e-5, -0.9e-5, 0.5e-5], [-0.7e-5, 0.5e-5, -1.4e-5]]
initial = { alpha = 0.4, beta = 0.9, gamma = 1.3, alpha_rate = -380.0, beta_rate = 21.0 }
observer = { theta_o = 1.1, phi_o = 0.6, distance = 2.5 }
pulsar = { chi = 0.7, delta = -0.8, rho = 0.5 }
time = { start = 12.0, span = 2.0, samples = 41 }
"#;

/// A physical star given by constants in a frame that is not principal, seen from a known distance; its beam never passes the line of sight.
const TILTED: &str = r#"
star = { mass = 1.4, radius = 12.0, oblateness = 2e-5, spin_frequency = 50.0 }
lorentz_violation.tensor = [[1e-9, 2e-10, 0.0], [2e-10, -3e-10, 1e-10], [0.0, 1e-10, -7e-10]]
initial = { kind = "twofold", alpha_0 = 0.3, beta_0 = 0.7, amplitude = 0.001, phase = 0.0 }
observer = { theta_o = 1.5, phi_o = 0.0, distance = 1.0 }
pulsar = { chi = 0.1, rho = 0.05 }
time = { span = 5.0, samples = 3 }
"#;

/// A star at rest, which librates; its lines are named by the angles of the torus.
const AT_REST: &str = r#"
star = { inertia_ratio = 1.1, spin = 0.0 }
lorentz_violation.eigenvalues = [0.02, 0.01, -0.04]
initial = { alpha = 1.2, beta = 0.7, gamma = 0.3, alpha_rate = 0.0, beta_rate = 0.0 }
observer = { theta_o = 0.8, phi_o = 0.2 }
pulsar = { chi = 0.5, delta = 0.1, rho = 0.6 }
time = { span = 100.0, samples = 101 }
"#;

/// A star that does not turn about its symmetry axis.
const SPINLESS: &str = r#"
star = { inertia_ratio = 1.1, spin = 0.0 }
lorentz_violation.eigenvalues = [0.02, 0.01, -0.04]
initial = { alpha = 1.2, beta = 0.7, gamma = 0.3, alpha_rate = 1.4, beta_rate = 0.1 }
observer = { theta_o = 0.8, phi_o = 0.2 }
pulsar = { chi = 0.5, delta = 0.1, rho = 0.6 }
time = { span = 100.0, samples = 101 }
"#;

/// Runs of more methods than exist.
pub(super) fn made_up_runs() -> Vec<Row> {
    let run = |scene: &str, carries, method: usize, i: i32| Row {
        scene: scene.to_owned(),
        method: format!("method {method} with a long name"),
        carries,
        setting: 0.0,
        error: 10f64.powi(-2 * i),
        times: Times { least: 1e-4 * f64::from(i) * (1 + method) as f64, median: 0.0 },
        steps: 0,
        evaluations: 0,
    };
    let scenes = ["tp-II", "nearly-free", "strongly-violated"];
    let cases = scenes.iter().flat_map(|scene| Carries::ALL.map(|carries| (scene, carries)));
    cases
        .flat_map(|(scene, carries)| (0..9).flat_map(move |m| (1..8).map(move |i| run(scene, carries, m, i))))
        .collect()
}

/// A star in the paper's units with `I^zz / I^xx` = 1.1, an observer and a beam, for 5 t_c, from its spin, the eigenvalues of `s` and its initial
/// values.
pub(super) fn star(name: &str, spin: f64, s: [f64; 3], initial: &str) -> Subject {
    let text = format!(
        "star = {{ inertia_ratio = 1.1, spin = {spin:?} }}\nlorentz_violation.eigenvalues = {s:?}\ninitial = {{ {initial} }}\n\
         observer = {{ theta_o = 0.8, phi_o = 0.0 }}\npulsar = {{ chi = 0.5, rho = 0.6 }}\ntime = {{ span = 5.0, samples = 3 }}\n"
    );
    of_text(name, &text)
}

/// Twofold precession by its constants, and initial values as angles and rates.
pub(super) const CONSTANTS: &str = "kind = \"twofold\", alpha_0 = 0.3, beta_0 = 0.7, amplitude = 0.0, phase = 0.0";
pub(super) const ANGLES: &str = "alpha = 0.3, beta = 0.7, gamma = 0.1, alpha_rate = 1.4, beta_rate = 0.0";

/// Free precession about Z by its constants: `alpha'` is 1.1 / cos 0.7 and `gamma'` -0.1.
pub(super) fn free(name: &str) -> Subject {
    star(name, 1.0, [0.0; 3], CONSTANTS)
}

/// The physical star in free precession, with the given signs of the rate of `alpha` and of the spin.
pub(super) fn tone(alpha: f64, spin: f64) -> Subject {
    let text = TONE.replace("alpha_rate = 375.2601393880295", &format!("alpha_rate = {:?}", alpha * 375.2601393880295));
    of_text("tone", &text.replace("spin_frequency = 57.0", &format!("spin_frequency = {:?}", spin * 57.0)))
}

fn of_text(name: &str, text: &str) -> Subject {
    Subject::of_scene(name, &Scene::from_toml(name, text).expect("a scene")).expect("a motion")
}

/// A spectral line.
pub(super) fn line(frequency: f64, amplitude: f64, terms: &[(i32, &'static str)]) -> SpectralLine {
    let combination = Combination { terms: terms.to_vec() };
    SpectralLine { frequency, amplitude, phase: 0.0, uncertainty: 0.0, combination }
}
