//! Videos that are read again.

use std::path::Path;
use std::process::Command;

use super::*;

const SIZE: [u32; 2] = [7, 5];

/// A dark picture with one light pixel.
fn picture(at: usize) -> Vec<u8> {
    let mut pixels = [10, 20, 30].repeat((SIZE[0] * SIZE[1]) as usize);
    pixels[3 * at..3 * at + 3].copy_from_slice(&[200, 100, 50]);
    pixels
}

/// Three pictures, of which the second is shown twice.
fn write(path: &Path, rate: f64) -> Result<(), VideoError> {
    let mut video = create(path, VideoFormat { size: SIZE, rate })?;
    for at in [3, 33, 33, 0] {
        video.add(&picture(at), 1)?;
    }
    video.finish()
}

#[test]
fn a_webp_has_all_pictures_and_times() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.webp");
    write(&path, 30.0).unwrap();
    let file = std::fs::read(&path).unwrap();
    assert_eq!(
        u32::from_le_bytes([file[4], file[5], file[6], file[7]]) as usize + 8,
        file.len()
    );
    let mut decoder = image_webp::WebPDecoder::new(std::io::Cursor::new(&file)).unwrap();
    assert_eq!((decoder.dimensions(), decoder.num_frames()), ((7, 5), 3));
    let mut pixels = vec![0; decoder.output_buffer_size().unwrap()];
    let bytes = pixels.len() / 35;
    for (at, duration) in [(3, 33), (33, 67), (0, 33)] {
        assert_eq!(decoder.read_frame(&mut pixels).unwrap(), duration);
        let rgb: Vec<u8> = pixels
            .chunks(bytes)
            .flat_map(|pixel| &pixel[..3])
            .copied()
            .collect();
        assert_eq!(rgb, picture(at), "{at}");
    }
}

#[test]
fn a_gif_has_all_pictures_and_times() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gif");
    write(&path, 20.0).unwrap();
    let mut options = ::gif::DecodeOptions::new();
    options.set_color_output(::gif::ColorOutput::RGBA);
    let mut decoder = options
        .read_info(std::fs::File::open(&path).unwrap())
        .unwrap();
    assert_eq!((decoder.width(), decoder.height()), (7, 5));
    let mut delays = Vec::new();
    let mut shown = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        delays.push(frame.delay);
        shown.resize(shown.len().max(frame.buffer.len()), 0);
        if delays.len() == 1 {
            shown.copy_from_slice(&frame.buffer);
        }
    }
    assert_eq!(delays, [5, 10, 5]);
    let rgb: Vec<u8> = shown
        .chunks(4)
        .flat_map(|pixel| &pixel[..3])
        .copied()
        .collect();
    assert_eq!(rgb, picture(3));
}

#[test]
fn a_series_has_a_file_for_each_picture() {
    let folder = tempfile::tempdir().unwrap();
    write(&folder.path().join("a-%03d.png"), 20.0).unwrap();
    let file = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert_eq!(file("a-001.png"), file("a-002.png"));
    let last = crate::picture::Picture::decode(&file("a-003.png"), crate::picture::Layout::Rgb);
    assert_eq!(last.unwrap().into_bytes(), picture(0));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 4);
}

#[test]
fn the_same_pictures_are_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    for kind in ["webp", "gif"] {
        let [one, other] = ["one", "other"].map(|name| {
            let path = folder.path().join(name).with_extension(kind);
            write(&path, 25.0).unwrap();
            std::fs::read(path).unwrap()
        });
        assert_eq!(one, other);
    }
}

#[test]
fn what_is_not_finished_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut video = create(
        &folder.path().join("a.webp"),
        VideoFormat {
            size: SIZE,
            rate: 25.0,
        },
    )
    .unwrap();
    video.add(&picture(0), 1).unwrap();
    drop(video);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn wrong_names_are_errors() {
    let format = VideoFormat {
        size: SIZE,
        rate: 25.0,
    };
    let reason = |name: &str| {
        create(Path::new(name), format)
            .map(|_| ())
            .unwrap_err()
            .to_string()
    };
    assert!(reason("a.xyz").starts_with("unknown kind of video: xyz (known: webp, gif, "));
    assert!(reason("a").starts_with("unknown kind of video: "));
    assert_eq!(
        reason("a.png"),
        "the name of a series has one place for the number, such as out-%05d.png"
    );
    assert!(matches!(
        create(Path::new("/no/such/folder/a.gif"), format),
        Err(VideoError::Io(_))
    ));
}

/// Without ffmpeg the error says what to install; with it there is a file.
#[test]
fn ffmpeg_makes_other_files() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.mkv");
    let result = write(&path, 25.0);
    let is_there = Command::new(PROGRAM).arg("-version").output().is_ok();
    match result {
        Ok(()) => assert!(is_there && std::fs::metadata(&path).unwrap().len() > 100),
        Err(error) => assert!(
            !is_there && error.to_string().contains("apt install ffmpeg"),
            "{error}"
        ),
    }
    assert_eq!(
        std::fs::read_dir(folder.path()).unwrap().count(),
        usize::from(is_there)
    );
}
