//! The numbers varied by a sweep, as pure functions of the scene's number.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, Normal, StandardUniform};

/// All varied numbers. Scene `k` takes, on each axis, the point given by counting through all combinations, with the last
/// axis fastest; a random axis has as many points as there are draws and comes last.
#[derive(Debug)]
pub(super) struct Parameters {
    /// Dotted keys in the scene, in the order of the sweep file.
    pub(super) keys: Vec<String>,
    /// Where the numbers of each key come from.
    pub(super) sources: Vec<Source>,
    /// Number of points of each axis.
    pub(super) lengths: Vec<u64>,
    /// Key of the random numbers.
    pub(super) seed: u64,
}

/// Numbers of a list or of a grid.
#[derive(Debug)]
pub(super) enum Points {
    Values(Vec<f64>),
    /// Between two ends, both included.
    Grid {
        from: f64,
        to: f64,
        /// Whether the ratios of neighbours are equal, rather than their differences.
        logarithmic: bool,
    },
}

#[derive(Debug)]
pub(super) enum Source {
    /// The points of an axis.
    Axis(usize, Points),
    /// Drawn independently for each scene.
    Random {
        /// Stream of random numbers, separate for each such parameter.
        stream: u64,
        law: Law,
    },
}

/// A distribution of random numbers.
#[derive(Debug, Clone, Copy)]
pub(super) enum Law {
    /// Uniform distribution of the number itself, `from` included.
    Uniform {
        from: f64,
        to: f64,
    },
    /// Uniform distribution of its logarithm.
    LogUniform {
        from: f64,
        to: f64,
    },
    Normal(Normal<f64>),
}

/// Words of a stream reserved for each draw: a normal one takes two, and two more in one of 80 cases.
const WORDS_PER_DRAW: u128 = 64;

impl Parameters {
    pub(super) fn count(&self) -> Option<u64> {
        self.lengths.iter().try_fold(1_u64, |count, &length| count.checked_mul(length))
    }

    /// The numbers of scene `scene`, in the order of the keys.
    pub(super) fn of_scene(&self, scene: u64) -> Vec<f64> {
        let mut points = vec![0; self.lengths.len()];
        let mut rest = scene;
        for (point, &length) in points.iter_mut().zip(&self.lengths).rev() {
            (rest, *point) = (rest / length, rest % length);
        }
        let number = |source: &Source| match source {
            Source::Axis(axis, Points::Values(values)) => values[points[*axis] as usize],
            Source::Axis(axis, Points::Grid { from, to, logarithmic }) => {
                grid_point(*from, *to, *logarithmic, points[*axis], self.lengths[*axis] - 1)
            }
            Source::Random { stream, law } => law.draw(self.seed, *stream, scene),
        };
        self.sources.iter().map(number).collect()
    }
}

/// Point `i` of `0..=last`; the ends are exact.
fn grid_point(from: f64, to: f64, logarithmic: bool, i: u64, last: u64) -> f64 {
    let part = i as f64 / last as f64;
    match i {
        0 => from,
        i if i == last => to,
        _ if logarithmic => in_equal_ratios(from, to, part),
        _ => from * (1.0 - part) + to * part,
    }
}

/// The number that is a `part` of the way from `from` to `to`, which have the same sign, in equal ratios.
fn in_equal_ratios(from: f64, to: f64, part: f64) -> f64 {
    let ratio = to / from;
    if ratio.is_normal() {
        from * ratio.powf(part)
    } else {
        // The ratio over- or underflows, these do not.
        from.signum() * from.abs().powf(1.0 - part) * to.abs().powf(part)
    }
}

impl Law {
    /// The number drawn for a scene. It depends on the arguments alone: the keystream is read from the position of the scene.
    fn draw(self, seed: u64, stream: u64, scene: u64) -> f64 {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        let mut stream_of_parameter = ChaCha8Rng::from_seed(key);
        stream_of_parameter.set_stream(stream);
        stream_of_parameter.set_word_pos(u128::from(scene) * WORDS_PER_DRAW);
        let mut part = || -> f64 { stream_of_parameter.sample(StandardUniform) };
        match self {
            Law::Uniform { from, to } => {
                let part = part();
                from * (1.0 - part) + to * part
            }
            Law::LogUniform { from, to } => in_equal_ratios(from, to, part()),
            Law::Normal(normal) => normal.sample(&mut stream_of_parameter),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parameters(sources: Vec<Source>, lengths: Vec<u64>) -> Parameters {
        let keys = (0..sources.len()).map(|i| i.to_string()).collect();
        Parameters { keys, sources, lengths, seed: 7 }
    }

    #[test]
    fn the_last_axis_is_the_fastest_and_zipped_parameters_go_together() {
        let values = |values: &[f64]| Source::Axis(0, Points::Values(values.to_vec()));
        let grid = Source::Axis(1, Points::Grid { from: 1.0, to: 1000.0, logarithmic: true });
        let all = parameters(vec![values(&[1.0, 2.0]), grid, values(&[-1.0, -2.0])], vec![2, 4]);
        assert_eq!(all.count(), Some(8));
        let rows: Vec<_> = (0..8).map(|k| all.of_scene(k)).collect();
        assert_eq!(rows[0], [1.0, 1.0, -1.0]);
        assert!((rows[1][1] - 10.0).abs() < 1e-14 && (rows[2][1] - 100.0).abs() < 1e-13, "{rows:?}");
        assert_eq!(rows[3], [1.0, 1000.0, -1.0]);
        assert_eq!(rows[7], [2.0, 1000.0, -2.0]);
        assert_eq!(parameters(vec![], vec![u64::MAX, 2]).count(), None);
    }

    /// Between ends whose ratio is no normal number: each logarithm is a few roundings off, of up to 745.
    #[test]
    fn equal_ratios_go_through_all_doubles() {
        for (from, to, middle) in [
            (1e-300, 1e300, 1.0),
            (-1e300, -1e-300, -1.0),
            (f64::MAX, f64::MIN_POSITIVE, 2.0),
            (1e160, 1e-160, 1.0),
            (f64::from_bits(1), 4.0, 2.0_f64.powi(-536)),
        ] {
            let grid = parameters(vec![Source::Axis(0, Points::Grid { from, to, logarithmic: true })], vec![3]);
            let points: Vec<_> = (0..3).flat_map(|k| grid.of_scene(k)).collect();
            assert_eq!([points[0], points[2]], [from, to]);
            assert!((points[1] / middle - 1.0).abs() < 1e-12, "{points:?}");
            for scene in 0..1000 {
                let drawn = Law::LogUniform { from, to }.draw(5, 0, scene);
                let (least, most) = (from.min(to), from.max(to));
                assert!(least <= drawn && drawn <= most, "{drawn} from {from} to {to}");
            }
        }
    }

    /// Moments of 40,000 draws within five standard errors, and literal numbers: a sweep's rows never change.
    #[test]
    fn draws_have_their_distributions_and_never_change() {
        let laws = [
            (Law::Uniform { from: -1.0, to: 3.0 }, 1.0, 4.0 / 12.0_f64.sqrt()),
            (Law::LogUniform { from: 1.0, to: std::f64::consts::E }, std::f64::consts::E - 1.0, 0.492),
            (Law::Normal(Normal::new(2.0, 0.5).expect("a law")), 2.0, 0.5),
        ];
        const DRAWS: u64 = 40_000;
        for (law, mean, deviation) in laws {
            let draws: Vec<_> = (0..DRAWS).map(|scene| law.draw(11, 3, scene)).collect();
            let found = draws.iter().sum::<f64>() / DRAWS as f64;
            let spread = (draws.iter().map(|x| (x - found) * (x - found)).sum::<f64>() / DRAWS as f64).sqrt();
            assert!((found - mean).abs() < 5.0 * deviation / (DRAWS as f64).sqrt(), "{law:?}: mean {found}");
            assert!((spread - deviation).abs() < 0.02 * deviation, "{law:?}: standard deviation {spread}");
        }
        let of = |seed, stream, scene| Law::Uniform { from: 0.0, to: 1.0 }.draw(seed, stream, scene);
        let known = [
            ((1, 0, 0), 0.381_489_413_238_261),
            ((1, 0, 1), 0.488_811_115_996_276_6),
            ((1, 1, 0), 0.103_533_138_648_742_47),
            ((2, 0, 0), 0.976_435_583_270_781_5),
            ((1, 0, 1_000_000_000_001), 0.102_682_416_390_670_22),
        ];
        for ((seed, stream, scene), draw) in known {
            assert_eq!(of(seed, stream, scene), draw, "seed {seed}, stream {stream}, scene {scene}");
        }
    }
}
