//! glTF files on disk: read with what they name, as models, and written.

use std::path::Path;

use super::GltfFile;
use crate::scene_file::{save, write_whole};
use crate::ttt::File;
use permissions::Permissions;
use scene::object::dummy::Dummy;
use scene::{Field, Handle, Kind, ModelFlags, Scene, SceneResult, clean_alias};

/// Of the dummy above several objects, metres.
const DUMMY: f64 = 0.01;

impl GltfFile {
    /// Whether a file's name is that of a glTF file.
    pub fn has_name_of(path: &Path) -> bool {
        let extension = path.extension().unwrap_or_default();
        ["glb", "gltf"]
            .iter()
            .any(|known| extension.eq_ignore_ascii_case(known))
    }

    /// Reads a file, and those beside it that it names.
    ///
    /// # Errors
    /// When it may not or cannot be read, or is damaged; in words.
    pub fn open(path: &Path, permissions: &Permissions) -> Result<Self, String> {
        let bytes = permissions
            .read_file(path)
            .map_err(|error| error.to_string())?;
        Self::parse(&bytes, path, permissions)
    }

    /// Reads the contents of a file. What it names lies beside `path`.
    ///
    /// # Errors
    /// When they are damaged; in words.
    pub fn parse(bytes: &[u8], path: &Path, permissions: &Permissions) -> Result<Self, String> {
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut resolve = |name: &str| {
            permissions
                .read_file(&folder.join(name))
                .map_err(|error| error.to_string())
        };
        Self::read(bytes, &mut resolve).map_err(|error| error.to_string())
    }

    /// Its objects as a model, and what was left out.
    ///
    /// # Errors
    /// When it has none; in words.
    pub fn model(self, path: &Path) -> Result<(File, Vec<String>), String> {
        let mut scene = Scene::new();
        let (handles, warnings) = self.add_to(&mut scene).map_err(|error| error.to_string())?;
        if handles.is_empty() {
            return Err("there are no objects in it".into());
        }
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let base = base(&mut scene, &handles, &name).map_err(|error| error.to_string())?;
        let file = save::model(&scene, base, &[]).map_err(|error| error.to_string())?;
        Ok((
            file,
            self.asset.warnings.into_iter().chain(warnings).collect(),
        ))
    }

    /// All objects of a scene.
    ///
    /// # Errors
    /// When a texture is not in the scene.
    pub fn of_scene(scene: &Scene) -> SceneResult<Self> {
        let mut file = Self::default();
        let all: Vec<Handle> = scene.objects().map(scene::Object::handle).collect();
        file.add_objects(scene, &all, "png")?;
        Ok(file)
    }

    /// Writes it, as text where the name ends so.
    ///
    /// # Errors
    /// When it is too large, or the file cannot be written; in words.
    pub fn write(&self, path: &Path) -> Result<(), String> {
        let is_text = path
            .extension()
            .is_some_and(|extension| extension.eq_ignore_ascii_case("gltf"));
        let bytes = if is_text {
            self.asset.to_text().map(String::into_bytes)
        } else {
            self.asset.to_binary()
        };
        write_whole(path, &bytes.map_err(|error| error.to_string())?)
            .map_err(|error| error.to_string())
    }
}

/// The only object without a parent, or a dummy above all of them; as the base of a model.
fn base(scene: &mut Scene, handles: &[Handle], name: &str) -> SceneResult<Handle> {
    let is_root = |handle: &Handle| {
        scene
            .object(*handle)
            .is_ok_and(|object| object.parent().is_none())
    };
    let roots: Vec<Handle> = handles.iter().copied().filter(is_root).collect();
    let base = match roots.as_slice() {
        [base] => *base,
        _ => scene.add(
            &clean_alias(name.as_bytes()),
            Kind::Dummy(Dummy::new(DUMMY)),
        )?,
    };
    for root in roots.into_iter().filter(|root| *root != base) {
        scene.set_parent(root, Some(base), true)?;
    }
    scene.modify(base, Field::ObjectProperty, |object| {
        object.set_model_property(ModelFlags::empty());
    })?;
    Ok(base)
}
