//! The mesh files that a description names.

use std::path::{Path, PathBuf};
use std::rc::Rc;

use mesh_files::{Limits, MeshFile, MeshFormat};
use robot_description::Search;

use crate::mesh_file::{ImportedAppearance, to_shapes};
use permissions::Permissions;
use scene::shape::Shape;
use scene::{Pose, Scene};

/// The longest side of a texture, pixels: larger ones are made smaller, as sim.importShape does.
const MAX_TEXTURE_SIDE: u32 = 512;

/// Finds and reads mesh files.
#[derive(Debug)]
pub(super) struct MeshFiles {
    search: Search,
    permissions: Permissions,
    warnings: Vec<String>,
    /// The last one, which is often both seen and touched.
    last: Option<(PathBuf, Rc<MeshFile>)>,
    /// What was made of it last, and how it was stretched.
    made: Option<(Rc<MeshFile>, [f64; 3], Shape)>,
}

impl MeshFiles {
    /// For a description at `path`. `replacement` stands for `package://`.
    pub(super) fn new(path: &Path, replacement: Option<String>, permissions: &Permissions) -> Self {
        let mut search = Search::beside(path).with_variables(|name| variable(name, permissions));
        search.replacement = replacement;
        Self {
            search,
            permissions: permissions.clone(),
            warnings: Vec::new(),
            last: None,
            made: None,
        }
    }

    /// What was left out of the files that were read since the last call.
    pub(super) fn take_warnings(&mut self) -> Vec<String> {
        std::mem::take(&mut self.warnings)
    }

    /// The shape of a mesh file, stretched by a factor for each axis. Its frame is that of the file; where the file says what points up does not matter.
    /// Textures become ones of the scene, if it is to have them.
    ///
    /// # Errors
    /// When there is no such file, it may not or cannot be read, or has no triangles; in words.
    pub(super) fn shape(
        &mut self,
        name: &str,
        scale: [f64; 3],
        scene: &mut Scene,
        with_textures: bool,
    ) -> Result<Shape, String> {
        let path = self.find(name)?;
        let failed = |reason: String| format!("mesh '{}': {reason}", path.display());
        let file = self.read(&path).map_err(failed)?;
        if let Some((last, factors, shape)) = &self.made
            && Rc::ptr_eq(last, &file)
            && *factors == scale
        {
            return Ok(copied(shape));
        }
        let unit = file.unit.unwrap_or(1.0);
        let mut stretched = stretched(&file, scale.map(|factor| factor * unit));
        let imported = ImportedAppearance {
            colours: true,
            transparency: false,
            textures: with_textures.then_some(MAX_TEXTURE_SIDE),
        };
        let shapes = to_shapes(&mut stretched, imported, scene)
            .map_err(|error| failed(error.to_string()))?;
        self.warnings.extend(
            stretched
                .warnings
                .iter()
                .map(|warning| failed(warning.clone())),
        );
        let shape = joined(shapes).map_err(failed)?;
        // Without textures it is the same whoever asks for it.
        let is_plain = file.textures.is_empty();
        self.made = is_plain.then(|| (file, scale, copied(&shape)));
        Ok(shape)
    }

    /// A file, in its own unit of length: as MJCF takes it.
    ///
    /// # Errors
    /// As [`shape`](Self::shape).
    pub(super) fn named(&mut self, name: &str) -> Result<Rc<MeshFile>, String> {
        let path = self.find(name)?;
        self.read(&path)
            .map_err(|reason| format!("mesh '{}': {reason}", path.display()))
    }

    fn find(&self, name: &str) -> Result<PathBuf, String> {
        let may_be_read = |path: &Path| {
            self.permissions.check_read(path).is_ok() && self.permissions.is_file(path)
        };
        self.search
            .find(name, &may_be_read)
            .map_err(|missing| missing.to_string())
    }

    fn read(&mut self, path: &Path) -> Result<Rc<MeshFile>, String> {
        if let Some((last, file)) = &self.last
            && last == path
        {
            return Ok(file.clone());
        }
        let format =
            MeshFormat::of_name(&path.to_string_lossy()).ok_or("its format is not known")?;
        let bytes = self
            .permissions
            .read_file(path)
            .map_err(|error| error.to_string())?;
        let mut beside = |name: &str| self.read_beside(path, name);
        let file = mesh_files::read(&bytes, format, Limits::default(), &mut beside)
            .map_err(|error| error.to_string())?;
        self.warnings.extend(
            file.warnings
                .iter()
                .map(|warning| format!("mesh '{}': {warning}", path.display())),
        );
        let file = Rc::new(file);
        self.last = Some((path.to_owned(), file.clone()));
        Ok(file)
    }

    /// A file that a mesh file names.
    fn read_beside(&self, mesh: &Path, name: &str) -> Result<Vec<u8>, String> {
        let path = mesh
            .parent()
            .unwrap_or(Path::new(""))
            .join(name.replace('\\', "/"));
        self.permissions
            .read_file(&path)
            .map_err(|error| error.to_string())
    }
}

/// What says where the packages of ROS are. It only decides where files are found.
#[allow(
    clippy::disallowed_methods,
    reason = "ROS says by its environment where packages are"
)]
pub(super) fn variable(name: &str, permissions: &Permissions) -> Option<String> {
    permissions.check_environment().ok()?;
    let read = permissions
        .tape()
        .input("the environment", || std::env::var(name).ok());
    read.ok().flatten()
}

/// A file with its coordinates multiplied by a factor for each axis. Triangles that are mirrored by that keep their outer sides.
fn stretched(file: &MeshFile, scale: [f64; 3]) -> MeshFile {
    let mut file = MeshFile {
        warnings: Vec::new(),
        ..file.clone()
    };
    let [x, y, z] = scale;
    for part in &mut file.parts {
        part.merge_identical();
        part.vertices
            .iter_mut()
            .for_each(|vertex| *vertex = [vertex[0] * x, vertex[1] * y, vertex[2] * z]);
        if !(x == y && y == z && x > 0.0) {
            part.normals.clear();
        }
        if x * y * z < 0.0 {
            part.triangles
                .iter_mut()
                .for_each(|triangle| triangle.swap(1, 2));
            part.uv.iter_mut().for_each(|corners| corners.swap(1, 2));
        }
    }
    file
}

/// The same shape with meshes of its own: the tightest box around a mesh takes longer than all else.
fn copied(shape: &Shape) -> Shape {
    let mut copy = shape.clone();
    for part in &mut copy.parts {
        part.mesh = Rc::new((*part.mesh).clone());
    }
    copy
}

/// One shape of the parts of a file.
fn joined(mut shapes: Vec<Shape>) -> Result<Shape, String> {
    match shapes.as_slice() {
        [] => Err("it has no triangles".into()),
        [_] => Ok(shapes.remove(0)),
        [first, ..] => {
            let placed: Vec<(Pose, &Shape)> = shapes
                .iter()
                .map(|shape| (Pose::identity(), shape))
                .collect();
            Shape::from_placed(&placed, first).map_err(|error| error.to_string())
        }
    }
}
