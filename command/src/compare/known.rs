//! The authors' files: their content, and their known errors.

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Content {
    /// Euler angles, from the numerical motion and from the perturbation solution, and two body axes.
    Angles,
    /// `m.n` and the curves of period and width.
    Signal,
    /// Periods of the pulses.
    Periods,
    /// Durations of the pulses.
    Widths,
    /// Polarizations of the wave.
    Waves,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Column {
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
}

#[derive(Debug)]
pub(super) struct KnownFile {
    pub(super) name: &'static str,
    pub(super) content: Content,
    pub(super) example: &'static str,
    pub(super) rows: usize,
    /// Known errors of the published file, by quantity; for a series of pulses the error of `m.n`, whose roots they are.
    pub(super) own_errors: &'static [(&'static str, f64)],
}

impl KnownFile {
    pub(super) fn columns(&self) -> Vec<Column> {
        let names: &[_] = match self.content {
            Content::Angles => &[
                "alpha",
                "alpha, Eq. (33)",
                "beta",
                "beta, Eq. (33)",
                "e_x X",
                "e_x Y",
                "e_x Z",
                "e_z X",
                "e_z Y",
                "e_z Z",
            ],
            Content::Signal => &["m.n", "P, Eq. (51)", "W / <Phi'>"],
            Content::Periods => &["period"],
            Content::Widths => &["duration"],
            Content::Waves => &["h_+", "h_x"],
        };
        let unit = |name: &str| match name {
            _ if name.starts_with("alpha") || name.starts_with("beta") => "rad",
            "P, Eq. (51)" | "W / <Phi'>" | "period" | "duration" => "t_c",
            _ => "1",
        };
        names.iter().map(|name| Column { name, unit: unit(name) }).collect()
    }
}

const fn file(
    name: &'static str,
    content: Content,
    example: &'static str,
    rows: usize,
    own_errors: &'static [(&'static str, f64)],
) -> KnownFile {
    KnownFile { name, content, example, rows, own_errors }
}

/// All files that are compared. The errors are the largest differences, with two digits, between the published files and
/// reference motions by a 34-digit Taylor method: the files come from a general-purpose solver at its default tolerance.
pub(super) const KNOWN: [KnownFile; 12] = [
    file("tp1.dat", Content::Angles, "tp-I", 10_000, &[("alpha", 4.8e-7), ("beta", 9.6e-8)]),
    file("tp2.dat", Content::Angles, "tp-II", 10_000, &[]),
    file("sp1.dat", Content::Angles, "sp-I", 10_000, &[("alpha", 3.5e-6), ("beta", 2.0e-6)]),
    file("sp2.dat", Content::Angles, "sp-II", 10_000, &[]),
    file("mntp1.dat", Content::Signal, "tp-I", 10_000, &[("m.n", 2.7e-6)]),
    file("mntp2.dat", Content::Signal, "tp-II", 10_000, &[]),
    file("mntp1_pset.dat", Content::Periods, "tp-I", 95, &[("m.n", 2.7e-6)]),
    file("mntp2_pset.dat", Content::Periods, "tp-II", 140, &[]),
    file("mntp1_widset.dat", Content::Widths, "tp-I", 96, &[("m.n", 2.7e-6)]),
    file("mntp2_widset.dat", Content::Widths, "tp-II", 160, &[]),
    file("gwtp1.dat", Content::Waves, "tp-I", 10_000, &[("h_+", 3.4e-6), ("h_x", 3.4e-6)]),
    file("gwtp2.dat", Content::Waves, "tp-II", 10_000, &[]),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_in_rad_and_times_in_t_c() {
        let columns = KNOWN.iter().flat_map(KnownFile::columns);
        for Column { name, unit } in columns {
            let expected = match name.split(',').next().expect("a name") {
                "alpha" | "beta" => "rad",
                "P" | "W / <Phi'>" | "period" | "duration" => "t_c",
                _ => "1",
            };
            assert_eq!(unit, expected, "{name}");
        }
    }
}
