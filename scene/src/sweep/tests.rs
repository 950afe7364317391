//! Sweeps of one parameter of the second example of twofold precession.

use std::ops::Range;
use std::sync::atomic::AtomicBool;

use super::*;
use crate::scene_file::built_in;

const VARIED: &str = "[[vary]]\nparameter = 'initial.beta_0'\nvalues = [0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3]\n";

/// A sweep of tp-II with these lines after its first.
fn text(lines: &str) -> SweepText {
    let text = format!("scene = 'tp-2'\n{lines}");
    let built_in = |name: &str| Ok((name.to_owned(), built_in(name).expect("it is built in").toml.to_owned()));
    SweepText::with("sweep.toml", text, built_in).expect("a sweep")
}

/// The message that refuses a sweep.
fn refusal(lines: &str) -> Option<String> {
    Sweep::new(&text(lines)).err().map(String::from)
}

/// Names and numbers of the scenes of a sweep, all of which are computed.
fn table(lines: &str, scenes: Range<u64>) -> (Vec<String>, Vec<Vec<f64>>) {
    let text = text(lines);
    let sweep = Sweep::new(&text).expect("a sweep");
    let ([rows, errors], failed) = sweep.rows(scenes);
    assert_eq!((errors.as_slice(), failed), (b"".as_slice(), 0));
    let rows = String::from_utf8(rows).expect("text");
    let numbers = |row: &str| row.split(',').map(|field| field.parse().unwrap_or(f64::NAN)).collect();
    (sweep.header(), rows.lines().map(numbers).collect())
}

#[test]
fn a_sweep_says_where_the_star_is_at_the_end_and_how_well() {
    let (names, _) = table(&format!("{VARIED}[time]\nend = 10.0\n"), 0..1);
    let state = [
        "e_z_X@10.0 [1]",
        "e_z_Y@10.0 [1]",
        "e_z_Z@10.0 [1]",
        "L_X@10.0 [I_xx/t_c]",
        "L_Y@10.0 [I_xx/t_c]",
        "L_Z@10.0 [I_xx/t_c]",
    ];
    let errors = [
        "error_estimate@10.0 [1]",
        "e_z_length_error@10.0 [1]",
        "E_error@10.0 [C]",
        "Omega_z_error@10.0 [rad/t_c]",
        "K_error@10.0 [(I_xx/t_c)^2]",
    ];
    let expected = [["scene", "initial.beta_0", "status"].as_slice(), &state, &errors].concat();
    assert_eq!(names, expected);
    let text = text(&format!("{VARIED}[time]\nend = 10.0\n"));
    assert_eq!(Sweep::new(&text).expect("a sweep").errors_header(), ["scene", "initial.beta_0", "error"]);
}

/// Many motions at once agree with those of each scene, from its start on, also if that is not zero.
#[test]
fn many_scenes_are_as_each_by_itself() {
    let of = |columns: &str| {
        let times = "[time]\nstart = 1.0\ntimes = [4.0, 11.0]\n";
        table(&format!("{VARIED}{times}[output]\ncolumns = [{columns}]\ntolerance = 1e-12\n"), 0..9)
    };
    let (names, together) = of("'e_z', 'L'");
    // Errors are estimated for one scene after the other.
    let (more_names, by_themselves) = of("'e_z', 'L', 'errors'");
    assert_eq!((together.len(), by_themselves.len()), (9, 9));
    let same = names.iter().enumerate().filter(|(i, name)| *i != 2 && more_names.contains(name));
    let places: Vec<_> =
        same.map(|(i, name)| (i, more_names.iter().position(|other| other == name).unwrap())).collect();
    assert_eq!(places.len(), 2 + 2 * 6);
    for (one, other) in together.iter().zip(&by_themselves) {
        for (i, j) in &places {
            // Two motions to a tolerance of 1e-12 each.
            assert!((one[*i] - other[*j]).abs() < 1e-11, "{} {}", one[*i], other[*j]);
        }
    }
}

/// A row is the same to the byte whichever scenes are computed with it.
#[test]
fn a_row_does_not_depend_on_its_neighbours() {
    let text = text(&format!("{VARIED}[time]\nend = 11.0\n[output]\ncolumns = ['e_z', 'L']\n"));
    let sweep = Sweep::new(&text).expect("a sweep");
    let rows = |scenes| sweep.rows(scenes).0[0].clone();
    let whole = rows(0..9);
    assert_eq!([rows(0..4), rows(4..9)].concat(), whole);
    assert_eq!((0..9).flat_map(|number| rows(number..number + 1)).collect::<Vec<_>>(), whole);
}

/// A thousand and one points times 10^15 + 1 is one scene too many.
#[test]
fn scenes_are_counted_up_to_the_doubles() {
    let grid = |key: &str, points: u64| {
        format!("[[vary]]\nparameter = '{key}'\ngrid = {{ from = 0.1, to = 0.2, points = {points} }}\n")
    };
    let time = "[time]\nend = 10.0\n";
    let whole = text(&format!("{}{time}", grid("initial.beta_0", 1_000_000_000_000_000)));
    assert_eq!(Sweep::new(&whole).map(|sweep| sweep.scenes), Ok(1_000_000_000_000_000));
    let two = [grid("initial.beta_0", 1001), grid("initial.amplitude", 999_000_999_001)].concat();
    assert!(refusal(&format!("{two}{time}")).is_some_and(|why| why.contains("too many scenes; at most 1e15")));
}

/// The mean angle, and pulses, require every turn to be followed; the end of a motion alone may be far away.
#[test]
fn what_goes_through_every_turn_has_a_longest_span() {
    let far = |output: &str| refusal(&format!("{VARIED}[time]\nend = 1e12\n[output]\n{output}\n"));
    for output in ["summaries = ['lambda']", "summaries = ['pulses']"] {
        assert!(far(output).is_some_and(|why| why.contains("[time] covers")), "{output}");
    }
    assert_eq!(far("columns = ['e_z']"), None);
}

/// The largest number is 1.797e308: 64 deviations of 2.79e306 are below it, and of 2.82e306 above.
#[test]
fn a_normal_law_has_as_wide_a_range_as_its_draws() {
    let with = |deviation: &str| {
        refusal(&format!(
            "seed = 1\ndraws = 2\n[[vary]]\nparameter = 'star.spin'\n\
             random = {{ distribution = 'normal', mean = 0.0, deviation = {deviation} }}\n[time]\nend = 1.0\n"
        ))
    };
    assert_eq!(with("2.79e306"), None);
    assert!(with("2.82e306").is_some_and(|why| why.contains("so small that every draw is finite")));
}

#[test]
fn a_part_with_another_first_or_last_row_is_not_merged() {
    let lines = format!("{VARIED}[time]\ntimes = [3.0]\n");
    let text = text(&lines);
    let sweep = Sweep::new(&text).expect("a sweep");
    let ([rows, _], _) = sweep.rows(0..sweep.scenes);
    let whole = [csv_line(&sweep.header()), rows].concat();
    let merged = |part: &[u8]| {
        let mut parts =
            vec![("part".to_owned(), Box::new(std::io::Cursor::new(part.to_vec())) as Box<dyn std::io::BufRead>)];
        let mut table = Vec::new();
        merge(&sweep, &mut parts, &mut table).map(|_| table)
    };
    assert_eq!(merged(&whole), Ok(whole.clone()));
    for torn in 1..10 {
        let why = merged(&whole[..whole.len() - torn]).unwrap_err();
        assert_eq!(why, "part ends within the row of scene 8");
    }
    let why = merged(&[&whole[..], b"\n"].concat()).unwrap_err();
    assert_eq!(why, "part has a line that is not a row where scene 9 is expected");
    // Of other numbers only those of the first and the last row are noticed.
    for row in 0..9 {
        let mut lines: Vec<_> = whole.split_inclusive(|byte| *byte == b'\n').map(<[u8]>::to_vec).collect();
        let line = &mut lines[row + 1];
        let end = line.len() - 1;
        line.splice(end..end, *b"1");
        assert_eq!(merged(&lines.concat()).is_ok(), row != 0 && row != 8, "{row}");
    }
}

/// The first scene that is not written is reported each time that it changes, and the table is that of a single thread.
#[test]
fn a_sweep_tells_how_far_it_is() {
    let text = text(&format!(
        "{VARIED}[[vary]]\nparameter = 'initial.phase'\ngrid = {{ from = 0.0, to = 1.0, points = 100 }}\n[time]\nend = 10.0\n"
    ));
    let sweep = Sweep::new(&text).expect("a sweep");
    assert_eq!(sweep.scenes, 900);
    let threads = rayon::ThreadPoolBuilder::new().num_threads(2).build().expect("threads");
    for stopped in [false, true] {
        let folder = tempfile::tempdir().expect("a folder");
        let files = SpoolFiles::of(&folder.path().join("a.csv"));
        let mut spool =
            Spool::open(files.clone(), &Identity::new(&text, &(0..900)), [b"", b""], 0..900).expect("a table");
        let mut told = vec![0];
        let done = compute(&sweep, &mut spool, 900, &threads, &AtomicBool::new(stopped), |next| told.push(next));
        assert_eq!(done.expect("a table"), if stopped { Done::Stopped } else { Done::All });
        let rows = std::fs::read(&files.rows).expect("a table");
        if stopped {
            assert_eq!((told.as_slice(), rows.len()), ([0].as_slice(), 0));
        } else {
            assert!(
                told.is_sorted_by(|one, other| one < other) && told.len() > 3 && told.last() == Some(&900),
                "{told:?}"
            );
            assert!(rows == sweep.rows(0..900).0[0]);
        }
    }
}
