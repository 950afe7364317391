//! The list of figures and their sources.

use std::sync::LazyLock;

use super::{
    Caption, Figure, Subject, Table, alignment, alignment_spectra, beam_cone, bound_factor, euler_angles, line_atlas,
    method_map, momentum_sphere, motion, pulse_series, regime_map, spin_down, violation_residuals, wave_spectra, waves,
};

type OfMotions = fn(&str, &[&Subject]) -> Result<Sheet, String>;

#[derive(Clone, Copy)]
enum Maker {
    /// No motion.
    Alone(fn() -> Result<Sheet, String>),
    /// The required data and the drawing of motions: the paper's examples at the given places, or one of a scene.
    Motions(Needs, &'static [usize], OfMotions),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Needs {
    Nothing,
    Waves,
    ObserverAndBeam,
}

pub(super) struct Sheet {
    pub(super) caption: Caption,
    pub(super) tables: Vec<Table>,
    pub(super) svg: String,
}

#[derive(Clone, Copy)]
pub struct Recipe {
    pub name: &'static str,
    /// Number of the paper's figure, by order of appearance.
    pub paper_figure: Option<u8>,
    pub summary: &'static str,
    maker: Maker,
}

/// One figure per line: its name; its number in the paper, `-`, or `scene` for figures of any motion; its content.
const LIST: &str = include_str!("../../data/figures.txt");

/// All figures: the paper's in its order, then ours.
pub static RECIPES: LazyLock<Vec<Recipe>> = LazyLock::new(|| listed(false));

/// Figures of any motion, for a scene.
pub static OF_A_SCENE: LazyLock<Vec<Recipe>> = LazyLock::new(|| listed(true));

fn listed(of_a_scene: bool) -> Vec<Recipe> {
    let recipe = |line: &'static str| {
        let mut words = line.splitn(3, ' ');
        let [name, number, summary] = [words.next(), words.next(), words.next()].map(|word| word.expect("three words"));
        let maker = maker(name, if of_a_scene { &[0] } else { &[0, 1] });
        (of_a_scene == (number == "scene")).then(|| Recipe { name, paper_figure: number.parse().ok(), summary, maker })
    };
    LIST.lines().filter_map(recipe).collect()
}

/// The maker of a figure; `places` select among several motions.
fn maker(name: &str, places: &'static [usize]) -> Maker {
    match name {
        "euler-angles" => Maker::Alone(euler_angles::common),
        "euler-angles-yzx" => Maker::Alone(euler_angles::permuted),
        "beam-cone" => Maker::Alone(beam_cone::sheet),
        "bound-factor" => Maker::Alone(bound_factor::sheet),
        "perturbation-regimes" => Maker::Alone(regime_map::sheet),
        "line-atlas" => Maker::Alone(line_atlas::sheet),
        "spin-down" => Maker::Alone(spin_down::sheet),
        "violation-residuals" => Maker::Alone(violation_residuals::sheet),
        "method-regimes" => Maker::Alone(method_map::sheet),
        "motion" | "motion-tp-1" => Maker::Motions(Needs::Nothing, &[0], motion::sheet),
        "motion-tp-2" => Maker::Motions(Needs::Nothing, &[1], motion::sheet),
        "motion-sp-1" => Maker::Motions(Needs::Nothing, &[2], motion::sheet),
        "motion-sp-2" => Maker::Motions(Needs::Nothing, &[3], motion::sheet),
        "beam-alignment" => Maker::Motions(Needs::ObserverAndBeam, places, alignment::sheet),
        "beam-alignment-spectra" => Maker::Motions(Needs::ObserverAndBeam, places, alignment_spectra::sheet),
        "pulse-series" => Maker::Motions(Needs::ObserverAndBeam, places, pulse_series::sheet),
        "waves" => Maker::Motions(Needs::Waves, places, waves::sheet),
        "wave-spectra" => Maker::Motions(Needs::Waves, places, wave_spectra::sheet),
        "momentum-sphere" => Maker::Motions(Needs::Nothing, &[0, 1, 2, 3], momentum_sphere::sheet),
        other => panic!("what is the figure {other}?"),
    }
}

impl Recipe {
    /// The first requirement of the figure that a motion lacks.
    pub fn lacks(&self, motion: &Subject) -> Option<&'static str> {
        let Maker::Motions(needs, ..) = self.maker else { return None };
        match needs {
            Needs::Waves | Needs::ObserverAndBeam if motion.observer.is_none() => Some("the section [observer]"),
            Needs::Waves if motion.lacks_distance() => {
                Some("`observer.distance` [kpc], without which a physical star has no strain")
            }
            Needs::ObserverAndBeam if motion.pulsar.is_none() => Some("the section [pulsar]"),
            _ => None,
        }
    }

    /// Draws the figure: those of [`RECIPES`] with the four examples, those of [`OF_A_SCENE`] with one motion.
    pub fn draw(&self, motions: &[Subject]) -> Result<Figure, String> {
        let sheet = match self.maker {
            Maker::Alone(make) => make(),
            Maker::Motions(_, places, make) => {
                let chosen: Option<Vec<_>> = places.iter().map(|&i| motions.get(i)).collect();
                chosen.ok_or("a motion is missing".to_owned()).and_then(|chosen| make(self.name, &chosen))
            }
        };
        let Sheet { caption, tables, svg } = sheet.map_err(|error| format!("{}: {error}", self.name))?;
        let Self { name, paper_figure, summary, .. } = *self;
        Ok(Figure { name: name.to_owned(), paper_figure, summary: summary.to_owned(), caption, tables, svg })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each line of the list is a figure, in the same order.
    #[test]
    fn figures_are_those_of_the_list() {
        let line = |Recipe { name, paper_figure, summary, .. }: &Recipe, without: &str| {
            let number = paper_figure.map_or(without.to_owned(), |number| number.to_string());
            format!("{name} {number} {summary}")
        };
        let own = RECIPES.iter().map(|recipe| line(recipe, "-"));
        let found: Vec<_> = own.chain(OF_A_SCENE.iter().map(|recipe| line(recipe, "scene"))).collect();
        assert_eq!(found, LIST.lines().collect::<Vec<_>>());
    }
}
