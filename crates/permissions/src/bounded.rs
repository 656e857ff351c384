//! Whole files up to a size: a device may have no end, and a sparse file more bytes than there is memory.

use std::fs::File;
use std::io::{Error, Read, Result};
use std::path::Path;

/// Bytes of the largest file that is read.
const MAX_FILE_SIZE: u64 = 2 << 30;
/// Bytes that are read from a device or a pipe, which do not say how many they have.
const MAX_STREAM_SIZE: u64 = 64 << 20;

/// The bytes of a file.
///
/// # Errors
/// When it cannot be read, or is too large.
pub fn read_bounded(path: &Path) -> Result<Vec<u8>> {
    let file = File::open(path)?;
    let metadata = file.metadata()?;
    let (limit, what) = if metadata.is_file() {
        (MAX_FILE_SIZE, "it is larger than")
    } else {
        (MAX_STREAM_SIZE, "this device or pipe has more than")
    };
    let too_large = || Error::other(format!("{what} {} MiB", limit >> 20));
    if metadata.len() > limit {
        return Err(too_large());
    }
    let mut bytes = Vec::with_capacity(metadata.len() as usize);
    file.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit {
        Err(too_large())
    } else {
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::read_bounded;

    #[test]
    fn files_are_read_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        std::fs::write(&path, "text").unwrap();
        assert_eq!(read_bounded(&path).unwrap(), b"text");
    }

    #[test]
    fn what_is_too_large_is_refused_at_once() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sparse");
        std::fs::File::create(&path)
            .unwrap()
            .set_len(1 << 40)
            .unwrap();
        assert_eq!(
            read_bounded(&path).unwrap_err().to_string(),
            "it is larger than 2048 MiB"
        );
    }

    #[test]
    #[cfg(unix)]
    fn devices_are_read_up_to_a_bound() {
        assert_eq!(read_bounded(Path::new("/dev/null")).unwrap(), b"");
        let error = read_bounded(Path::new("/dev/zero"))
            .unwrap_err()
            .to_string();
        assert_eq!(error, "this device or pipe has more than 64 MiB");
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_pipe_may_have_as_many_bytes_as_the_bound() {
        use std::io::Write;
        use std::os::fd::AsRawFd;
        const BOUND: usize = 64 << 20;
        for (size, is_read) in [(BOUND, true), (BOUND + 1, false)] {
            let (reader, mut writer) = std::io::pipe().unwrap();
            let path = format!("/proc/self/fd/{}", reader.as_raw_fd());
            let writing = std::thread::spawn(move || writer.write_all(&vec![7; size]));
            let read = read_bounded(Path::new(&path));
            assert_eq!(read.is_ok_and(|bytes| bytes.len() == size), is_read);
            drop(reader);
            writing.join().unwrap().unwrap();
        }
    }
}
