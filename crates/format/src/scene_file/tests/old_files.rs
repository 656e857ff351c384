//! What chunks of old programs mean, and chunks that are missing (spec: scene-files 6, scene-files 7, scene-files 8, scene-files 9).

mod colours;
mod commons;
mod graphs;
mod mechanics;
mod scenes;
mod sensors;
mod settings;
mod shapes;
mod surfaces;
mod texts;

use super::super::{Loaded, SceneFile};
use crate::ttt::chunks::Common;
use crate::ttt::tree::{Class, Contents, Object as FileObject};
use crate::ttt::{File, FileKind, Header};
use scene::{Handle, Object, Scene};

/// A file of that release and format.
fn file(version: u16, serialization: i32, contents: Contents) -> File {
    let header = Header {
        serialization,
        version,
        ..Header::current(FileKind::Scene)
    };
    File {
        header,
        contents,
        skipped: Vec::new(),
    }
}

fn loaded(file: File) -> (Scene, Loaded) {
    let mut scene = Scene::new();
    let loaded = SceneFile::new(file).unwrap().add_to(&mut scene, true);
    (scene, loaded.unwrap())
}

/// An object with that handle and parent in the file.
fn object(handle: i32, parent: i32, class: Class) -> FileObject {
    FileObject {
        offset: 0,
        common: Common {
            handles: Some([handle, parent]),
            name: Some(format!("o{handle}").as_str().into()),
            ..Common::default()
        },
        class,
    }
}

/// The objects of a file of that release and format.
fn objects(version: u16, serialization: i32, objects: Vec<FileObject>) -> (Scene, Vec<Handle>) {
    let contents = Contents {
        objects,
        ..Contents::default()
    };
    let (scene, loaded) = loaded(file(version, serialization, contents));
    (scene, loaded.objects)
}

/// What becomes of one object of a present file.
fn one(class: Class) -> Object {
    one_of(41_000, 25, object(1, -1, class))
}

fn one_of(version: u16, serialization: i32, object: FileObject) -> Object {
    let (scene, handles) = objects(version, serialization, vec![object]);
    scene.object(handles[0]).unwrap().clone()
}
