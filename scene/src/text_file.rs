//! Text files of bounded size.

use std::fs::File;
use std::io::Read;

/// Largest file that is read, in bytes.
pub const LARGEST_FILE: u64 = 64 << 20;

/// The text of a file. Its size is bounded while reading, so that a device or a pipe cannot fill the memory.
///
/// # Errors
/// The file cannot be read, has more than 64 MiB, or is not UTF-8. The message is meant to follow the name of the file.
pub fn read_text(file: File) -> Result<String, String> {
    let mut bytes = Vec::new();
    file.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(|error| format!("cannot be read: {error}"))?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(format!("is larger than {} MiB, the largest file that is read", LARGEST_FILE >> 20));
    }
    text_of(bytes)
}

/// Bytes as text.
///
/// # Errors
/// The bytes are not UTF-8.
pub fn text_of(bytes: Vec<u8>) -> Result<String, String> {
    String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = valid.iter().filter(|&&byte| byte == b'\n').count() + 1;
        format!("is not UTF-8 text (byte {}, line {line})", valid.len() + 1)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_read_up_to_the_longest() {
        for (bytes, taken) in [(1 << 26, true), ((1 << 26) + 1, false)] {
            let file = tempfile::tempfile().expect("a file");
            file.set_len(bytes).expect("so long");
            let read = read_text(file).map(|text| text.len() as u64);
            let refused = "is larger than 64 MiB, the largest file that is read".to_owned();
            assert_eq!(read, if taken { Ok(bytes) } else { Err(refused) });
        }
    }

    #[test]
    fn bytes_that_are_not_text_are_told_with_their_line() {
        assert_eq!(text_of(b"a\nb\n".to_vec()), Ok("a\nb\n".to_owned()));
        assert_eq!(text_of(b"a\nb\xff".to_vec()), Err("is not UTF-8 text (byte 4, line 2)".to_owned()));
    }
}
