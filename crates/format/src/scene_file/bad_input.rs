//! Damaged files yield an error with a position, or a scene; never a panic or excessive memory use.

use test_support::random::Random;

use super::SceneFile;
use super::tests::own_files;
use crate::ttt::{File, FileError, FileKind, Header, container};
use scene::Scene;

fn model() -> Vec<u8> {
    std::fs::read(&own_files()[2]).unwrap()
}

/// A file whose body is not compressed, so that damage reaches the chunks.
fn plain(body: &[u8]) -> Vec<u8> {
    let mut file = container::pack(&Header::current(FileKind::Model), &[]);
    file.truncate(1021);
    file[12] = 0;
    file[13..17].copy_from_slice(&(body.len() as i32).to_le_bytes());
    file.extend(body);
    file
}

fn body() -> Vec<u8> {
    container::unpack(&model()).unwrap().1
}

fn load(bytes: &[u8]) -> Result<(), FileError> {
    let file = SceneFile::read(bytes)?;
    let mut scene = Scene::new();
    let loaded = file.add_to(&mut scene, true).unwrap();
    super::save::scene(&scene, &loaded.scripts).unwrap();
    Ok(())
}

#[test]
fn every_shortened_file_is_an_error() {
    let (file, body) = (
        super::save::scene(&scene::Scene::new(), &[])
            .unwrap()
            .write(),
        body(),
    );
    for end in 0..file.len() - 1 {
        assert!(File::read(&file[..end]).is_err(), "{end}");
    }
    for end in 0..body.len() {
        let error = File::read(&plain(&body[..end]))
            .err()
            .unwrap_or_else(|| panic!("{end} is enough"));
        assert!(
            matches!(&error, FileError::Chunk { offset, path, .. } if *offset <= end && !path.is_empty()),
            "{error}"
        );
    }
}

#[test]
fn flipped_bits_do_no_harm() {
    let body = body();
    let mut random = Random::new(1);
    for _ in 0..1000 {
        let mut damaged = body.clone();
        for _ in 0..=random.below(3) {
            let at = random.below(8 * damaged.len());
            damaged[at / 8] ^= 1 << (at % 8);
        }
        // Any result is right, as long as it ends.
        let _ = load(&plain(&damaged));
    }
}

#[test]
fn an_object_at_no_place_is_an_error() {
    let mut scene = Scene::new();
    scene
        .add(
            "far",
            scene::Kind::Dummy(scene::object::dummy::Dummy::new(0.1)),
        )
        .unwrap();
    let mut file = super::save::scene(&scene, &[]).unwrap();
    let far = scene::Pose::translation(1e300, 0.0, 0.0);
    file.contents.objects[0].common.pose = Some(far.into());
    let error = SceneFile::read(&file.write()).err().unwrap().to_string();
    assert!(
        error.contains("far") && error.contains("no place"),
        "{error}"
    );
}

#[test]
fn lengths_that_lie_are_errors_with_their_place() {
    for length in [i32::MAX, -1, i32::MIN, 1 << 24] {
        let chunk = [&b"VIN"[..], &length.to_le_bytes(), b"EOF"].concat();
        let error = SceneFile::read(&plain(&chunk)).err().unwrap().to_string();
        assert!(error.contains("TOP"), "{error}");
    }
}

#[test]
fn streams_within_streams_end() {
    let mut chunk = b"EOO".to_vec();
    for _ in 0..5000 {
        chunk = [
            &b"Wrp"[..],
            &(chunk.len() as i32).to_le_bytes(),
            &chunk,
            b"EOO",
        ]
        .concat();
    }
    let shape = [
        &b"3do\x03\0\0\0\x39\x3a\x3bNXT"[..],
        &wrapped(b"Ge2", &wrapped(b"Gsg", &chunk)),
        b"EOO",
    ]
    .concat();
    let error = SceneFile::read(&plain(&[wrapped(b"SHP", &shape), b"EOF".to_vec()].concat()))
        .err()
        .unwrap();
    assert!(error.to_string().contains("nested too deeply"), "{error}");
}

fn wrapped(tag: &[u8], payload: &[u8]) -> Vec<u8> {
    let end: &[u8] = if tag == b"SHP" { b"" } else { b"EOO" };
    let size = (payload.len() + end.len()) as i32;
    [tag, &size.to_le_bytes(), payload, end].concat()
}

#[test]
fn a_small_file_that_says_it_is_large_is_an_error() {
    let mut file = model();
    file[13..17].copy_from_slice(&i32::MAX.to_le_bytes());
    assert!(matches!(File::read(&file), Err(FileError::Inflate(_))));
}
