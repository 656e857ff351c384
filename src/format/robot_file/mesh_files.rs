//! The mesh files that a description names.

use std::path::{Path, PathBuf};
use std::rc::Rc;

use geometry::Mesh;
use mesh_files::{Format, Limits, Material, MeshFile, Part};
use robot_description::Search;

use crate::permissions::Permissions;
use crate::scene::Pose;
use crate::scene::shape::{Appearance, Shape};

/// Finds and reads mesh files.
#[derive(Debug)]
pub(super) struct MeshFiles {
    search: Search,
    permissions: Permissions,
    warnings: Vec<String>,
    /// The last one, which is often both seen and touched.
    last: Option<(PathBuf, Rc<MeshFile>)>,
}

impl MeshFiles {
    /// For a description at `path`. `replacement` stands for `package://`.
    pub(super) fn new(path: &Path, replacement: Option<String>, permissions: &Permissions) -> Self {
        let mut search = Search::beside(path).with_variables(|name| variable(name, permissions));
        search.replacement = replacement;
        Self { search, permissions: permissions.clone(), warnings: Vec::new(), last: None }
    }

    /// What was left out of the files that were read since the last call.
    pub(super) fn take_warnings(&mut self) -> Vec<String> {
        std::mem::take(&mut self.warnings)
    }

    /// The shape of a mesh file, stretched by a factor for each axis. Its frame is that of the file; where the file says what points up does not matter.
    ///
    /// # Errors
    /// When there is no such file, it may not or cannot be read, or has no triangles; in words.
    pub(super) fn shape(&mut self, name: &str, scale: [f64; 3]) -> Result<Shape, String> {
        let path = self.find(name)?;
        let file = self.read(&path).map_err(|reason| format!("mesh '{}': {reason}", path.display()))?;
        let unit = file.unit.unwrap_or(1.0);
        shape_of(&file, scale.map(|factor| factor * unit))
            .map_err(|reason| format!("mesh '{}': {reason}", path.display()))
    }

    fn find(&self, name: &str) -> Result<PathBuf, String> {
        let may_be_read = |path: &Path| self.permissions.check_read(path).is_ok() && path.is_file();
        self.search.find(name, &may_be_read).map_err(|missing| missing.to_string())
    }

    fn read(&mut self, path: &Path) -> Result<Rc<MeshFile>, String> {
        if let Some((last, file)) = &self.last
            && last == path
        {
            return Ok(file.clone());
        }
        let format = Format::of_name(&path.to_string_lossy()).ok_or("its format is not known")?;
        let bytes = self.permissions.read_file(path).map_err(|error| error.to_string())?;
        let mut beside = |name: &str| self.read_beside(path, name);
        let file =
            mesh_files::read(&bytes, format, Limits::default(), &mut beside).map_err(|error| error.to_string())?;
        self.warnings.extend(file.warnings.iter().map(|warning| format!("mesh '{}': {warning}", path.display())));
        let file = Rc::new(file);
        self.last = Some((path.to_owned(), file.clone()));
        Ok(file)
    }

    /// A file that a mesh file names.
    fn read_beside(&self, mesh: &Path, name: &str) -> Result<Vec<u8>, String> {
        let path = mesh.parent().unwrap_or(Path::new("")).join(name.replace('\\', "/"));
        self.permissions.read_file(&path).map_err(|error| error.to_string())
    }
}

/// What says where the packages of ROS are. It only decides where files are found.
#[allow(clippy::disallowed_methods, reason = "ROS says by its environment where packages are")]
fn variable(name: &str, permissions: &Permissions) -> Option<String> {
    permissions.check_environment().ok()?;
    std::env::var(name).ok()
}

fn shape_of(file: &MeshFile, scale: [f64; 3]) -> Result<Shape, String> {
    let mut shapes = Vec::new();
    for part in &file.parts {
        shapes.push(part_shape(part, scale)?);
    }
    match shapes.as_slice() {
        [] => Err("it has no triangles".into()),
        [_] => Ok(shapes.remove(0)),
        [first, ..] => {
            let placed: Vec<(Pose, &Shape)> = shapes.iter().map(|shape| (Pose::identity(), shape)).collect();
            Shape::from_placed(&placed, first).map_err(|error| error.to_string())
        }
    }
}

fn part_shape(part: &Part, scale: [f64; 3]) -> Result<Shape, String> {
    let mut part = part.clone();
    part.merge_identical();
    let mut mesh = Mesh::new(part.vertices, part.triangles).map_err(|error| error.to_string())?;
    mesh.scale(scale);
    Shape::from_mesh(mesh, appearance(&part.material)).map_err(|error| error.to_string())
}

fn appearance(material: &Material) -> Appearance {
    let mut appearance = Shape::mesh_appearance();
    let single = |colour: [f64; 3]| colour.map(|component| component.clamp(0.0, 1.0) as f32);
    if let Some(diffuse) = material.diffuse {
        appearance.colour.ambient_diffuse = single(diffuse);
    }
    if let Some(specular) = material.specular {
        appearance.colour.specular = single(specular);
    }
    appearance
}
