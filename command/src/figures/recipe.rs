//! Which figures there are, and what each is drawn from.

use super::{
    Caption, Figure, Subject, Table, alignment, alignment_spectra, beam_cone, bound_factor, euler_angles, method_map,
    momentum_sphere, motion, pulse_series, regime_map, wave_spectra, waves,
};

type OfMotions = fn(&str, &[&Subject]) -> Result<Sheet, String>;

#[derive(Clone, Copy)]
enum Maker {
    /// Nothing but itself.
    Alone(fn() -> Result<Sheet, String>),
    /// Motions with what the figure shows of them: those of the paper's examples with the given places, or one of a scene.
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

/// All figures: the paper's in its order, then ours.
pub const RECIPES: &[Recipe] = &[
    alone("euler-angles", Some(1), "Euler angles between the frames X-Y-Z and x-y-z", euler_angles::common),
    Recipe {
        name: "motion-tp-1",
        paper_figure: Some(2),
        summary: "Example I of twofold precession: Euler angles and the paths of the body axes",
        maker: Maker::Motions(Needs::Nothing, &[0], motion::sheet),
    },
    Recipe {
        name: "motion-tp-2",
        paper_figure: Some(3),
        summary: "Example II of twofold precession: Euler angles and the paths of the body axes",
        maker: Maker::Motions(Needs::Nothing, &[1], motion::sheet),
    },
    Recipe {
        name: "motion-sp-1",
        paper_figure: Some(4),
        summary: "Example I of single precession: Euler angles and the paths of the body axes",
        maker: Maker::Motions(Needs::Nothing, &[2], motion::sheet),
    },
    Recipe {
        name: "motion-sp-2",
        paper_figure: Some(5),
        summary: "Example II of single precession: Euler angles and the paths of the body axes",
        maker: Maker::Motions(Needs::Nothing, &[3], motion::sheet),
    },
    alone("euler-angles-yzx", Some(6), "Euler angles between the frames Y-Z-X and x-y-z", euler_angles::permuted),
    alone("beam-cone", Some(7), "Cone model of pulsar radiation: magnetic axis and line of sight", beam_cone::sheet),
    Recipe {
        name: "beam-alignment",
        paper_figure: Some(8),
        summary: "Cosine of the angle between beam and line of sight in time, tp-I and tp-II",
        maker: Maker::Motions(Needs::ObserverAndBeam, &[0, 1], alignment::sheet),
    },
    Recipe {
        name: "beam-alignment-spectra",
        paper_figure: Some(9),
        summary: "Spectra of the cosine of the angle between beam and line of sight, tp-I and tp-II",
        maker: Maker::Motions(Needs::ObserverAndBeam, &[0, 1], alignment_spectra::sheet),
    },
    Recipe {
        name: "pulse-series",
        paper_figure: Some(10),
        summary: "Periods and lengths of the pulses of tp-I and tp-II, with the curves of Eqs. (51), (56)",
        maker: Maker::Motions(Needs::ObserverAndBeam, &[0, 1], pulse_series::sheet),
    },
    Recipe {
        name: "waves",
        paper_figure: Some(11),
        summary: "Gravitational waves h_+ and h_x of tp-I and tp-II in time",
        maker: Maker::Motions(Needs::Waves, &[0, 1], waves::sheet),
    },
    Recipe {
        name: "wave-spectra",
        paper_figure: Some(12),
        summary: "Spectra of the gravitational waves of tp-I and tp-II, with the third harmonic enlarged",
        maker: Maker::Motions(Needs::Waves, &[0, 1], wave_spectra::sheet),
    },
    alone("bound-factor", None, "Factor eta of the bounds from pulsars against the inclination", bound_factor::sheet),
    alone("perturbation-regimes", None, "Error of the perturbation solutions over their parameters", regime_map::sheet),
    alone(
        "method-regimes",
        None,
        "Which approximate motion meets a given error, by strength of the torque and time",
        method_map::sheet,
    ),
    Recipe {
        name: "momentum-sphere",
        paper_figure: None,
        summary: "Directions of the angular momentum: contours, separatrix and paths of the examples",
        maker: Maker::Motions(Needs::Nothing, &[0, 1, 2, 3], momentum_sphere::sheet),
    },
];

/// Figures of any motion, for a scene.
pub const OF_A_SCENE: &[Recipe] = &[
    of_scene("motion", "Euler angles and the paths of the body axes", Needs::Nothing, motion::sheet),
    of_scene(
        "beam-alignment",
        "Cosine of the angle between beam and line of sight in time",
        Needs::ObserverAndBeam,
        alignment::sheet,
    ),
    of_scene(
        "beam-alignment-spectra",
        "Spectrum of the cosine of the angle between beam and line of sight",
        Needs::ObserverAndBeam,
        alignment_spectra::sheet,
    ),
    of_scene("pulse-series", "Periods and lengths of the pulses", Needs::ObserverAndBeam, pulse_series::sheet),
    of_scene("waves", "Gravitational waves h_+ and h_x in time", Needs::Waves, waves::sheet),
    of_scene("wave-spectra", "Spectra of the gravitational waves", Needs::Waves, wave_spectra::sheet),
];

const fn alone(
    name: &'static str,
    paper_figure: Option<u8>,
    summary: &'static str,
    make: fn() -> Result<Sheet, String>,
) -> Recipe {
    Recipe { name, paper_figure, summary, maker: Maker::Alone(make) }
}

const fn of_scene(name: &'static str, summary: &'static str, needs: Needs, make: OfMotions) -> Recipe {
    Recipe { name, paper_figure: None, summary, maker: Maker::Motions(needs, &[0], make) }
}

impl Recipe {
    /// What the figure needs of a scene file and a motion lacks.
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
