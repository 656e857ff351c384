//! Files on a disk and as bytes: what is read is what was written.

use super::super::read::{read_file, read_path};
use super::super::{SceneFile, part_of, write_whole};
use super::everything::dummy;
use super::{load, own_files};
use crate::ttt::{FileKind, Header, container};
use permissions::Permissions;
use scene::Scene;

#[test]
fn the_bytes_of_a_scene_hold_its_objects() {
    let mut scene = Scene::new();
    let named = dummy(&mut scene);
    scene.set_alias(named, b"somewhere").unwrap();
    let bytes = SceneFile::bytes_of(&scene, &[]).unwrap();
    let (again, loaded) = load(&bytes);
    assert_eq!(loaded.objects.len(), 1);
    assert_eq!(
        again.object(loaded.objects[0]).unwrap().alias(),
        "somewhere"
    );
}

#[test]
fn the_body_of_a_file_is_what_was_packed() {
    let file = container::pack(&Header::current(FileKind::Scene), b"a body");
    assert_eq!(SceneFile::body(&file).unwrap(), b"a body");
    assert!(SceneFile::body(&file[..20]).is_err());
}

#[test]
fn a_path_is_read_as_its_bytes_are() {
    let xml = own_files()[0].with_file_name("kinds.simscene.xml");
    for path in own_files().into_iter().chain([xml]) {
        let bytes = std::fs::read(&path).unwrap();
        let of_bytes = read_file(&bytes, path.parent(), &Permissions::all()).unwrap();
        let of_path = read_path(&path).unwrap();
        assert!(!of_path.contents.objects.is_empty(), "{path:?}");
        assert_eq!(of_path.write(), of_bytes.write(), "{path:?}");
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.ttt");
    assert!(read_path(&path).is_err());
    write_whole(&path, b"no scene").unwrap();
    assert!(read_path(&path).is_err());
}

#[test]
fn a_temporary_file_is_beside_the_file_it_becomes() {
    let folder = tempfile::tempdir().unwrap();
    let part = part_of(&folder.path().join("scene.ttt")).unwrap();
    assert_eq!(part.path().parent(), Some(folder.path()));
    // Nobody takes it for abandoned.
    assert!(fs4::FileExt::try_lock(&std::fs::File::open(part.path()).unwrap()).is_err());
}

#[test]
#[cfg(unix)]
fn what_a_link_leads_to_is_replaced_and_the_link_stays() {
    let folder = tempfile::tempdir().unwrap();
    let [target, link] = ["target.ttt", "link.ttt"].map(|name| folder.path().join(name));
    std::fs::write(&target, b"old").unwrap();
    std::os::unix::fs::symlink(&target, &link).unwrap();
    write_whole(&link, b"new").unwrap();
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(std::fs::read(&target).unwrap(), b"new");
}

#[test]
#[cfg(unix)]
fn new_files_have_the_rights_of_any_new_file() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let [ours, plain] = ["ours", "plain"].map(|name| folder.path().join(name));
    write_whole(&ours, b"").unwrap();
    std::fs::write(&plain, b"").unwrap();
    let mode = |path| std::fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&ours), mode(&plain));
}
