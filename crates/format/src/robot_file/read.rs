//! Files of descriptions: which they are, and what is in them.

use std::path::{Path, PathBuf};

use robot_description::mjcf::{self, Files, Triangles};
use robot_description::sdf::{self, Included};
use robot_description::{Parsed, ReadError, Search, urdf};

use super::bases::held_links;
use super::mesh_files::{MeshFiles, variable};
use super::{Description, RobotFile, RobotFormat};
use permissions::Permissions;
use scene::shape::{Fluid, MovingSurface};

impl RobotFormat {
    /// The format that a file's name says, or its beginning.
    fn of(path: &Path, start: &[u8]) -> Option<Self> {
        let ending = path
            .extension()
            .map(|ending| ending.to_string_lossy().to_lowercase());
        match ending.as_deref() {
            Some("urdf") => Some(Self::Urdf),
            Some("sdf" | "world") => Some(Self::Sdf),
            Some("mjcf") => Some(Self::Mjcf),
            Some("xml") if mjcf::is_mjcf(start) => Some(Self::Mjcf),
            _ => None,
        }
    }

    /// The element that is a link in it.
    pub(super) fn link_element(self) -> &'static str {
        match self {
            Self::Urdf | Self::Sdf => "link",
            Self::Mjcf => "body",
        }
    }

    /// The element that is a geometry in it, seen or touched.
    pub(super) fn geometry_element(self, is_seen: bool) -> &'static str {
        match (self, is_seen) {
            (Self::Mjcf, _) => "geom",
            (_, true) => "visual",
            (_, false) => "collision",
        }
    }
}

impl RobotFile {
    /// Whether a file is a robot, or a world, that can be imported: by its name, or as MJCF by its first element.
    pub fn is_one(path: &Path, permissions: &Permissions) -> bool {
        let is_xml = path
            .extension()
            .is_some_and(|ending| ending.eq_ignore_ascii_case("xml"));
        // What cannot be read is no robot; whoever reads it then says why.
        let start = if is_xml && permissions.is_file(path) {
            permissions.read_file(path).unwrap_or_default()
        } else {
            Vec::new()
        };
        RobotFormat::of(path, &start).is_some()
    }

    /// Whether a file's name is that of a robot that can be exported.
    pub fn has_name_of_urdf(path: &Path) -> bool {
        RobotFormat::of(path, &[]) == Some(RobotFormat::Urdf)
    }

    /// Reads a file of the format that its name, or its beginning, says.
    ///
    /// # Errors
    /// When it may not or cannot be read, or is no robot; in words.
    pub fn read(path: &Path, permissions: &Permissions) -> Result<Self, String> {
        Self::read_as(None, path, None, permissions)
    }

    /// Reads a file of a format. `replacement` stands for `package://` in it.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn read_as(
        format: Option<RobotFormat>,
        path: &Path,
        replacement: Option<String>,
        permissions: &Permissions,
    ) -> Result<Self, String> {
        let bytes = permissions
            .read_file(path)
            .map_err(|error| error.to_string())?;
        let path = permissions
            .absolute(path)
            .map_err(|error| error.to_string())?;
        let said = format.or_else(|| RobotFormat::of(&path, &bytes));
        Self::parse(
            &bytes,
            said.unwrap_or(RobotFormat::Urdf),
            &path,
            replacement,
            permissions,
        )
    }

    /// Reads the text of a file. Relative names in it mean files beside `path`.
    ///
    /// # Errors
    /// When it is no robot; in words.
    pub fn parse(
        text: &[u8],
        format: RobotFormat,
        path: &Path,
        replacement: Option<String>,
        permissions: &Permissions,
    ) -> Result<Self, String> {
        let mut meshes = MeshFiles::new(path, replacement, permissions);
        let read = match format {
            RobotFormat::Urdf => read_urdf(text),
            RobotFormat::Sdf => read_sdf(text, path, permissions),
            RobotFormat::Mjcf => read_mjcf(text, path, &mut meshes, permissions),
        };
        let Parsed {
            value: contents,
            warnings,
            further_warnings,
        } = read.map_err(|error| error.to_string())?;
        let mut warnings: Vec<String> = warnings.iter().map(ToString::to_string).collect();
        if further_warnings > 0 {
            warnings.push(format!("and {further_warnings} other warnings"));
        }
        let Contents {
            name,
            models,
            gravity,
        } = contents;
        Ok(Self {
            format,
            name,
            models,
            gravity,
            meshes,
            warnings,
        })
    }

    /// Whether its models have places in a world.
    pub fn has_world(&self) -> bool {
        self.gravity.is_some() || self.models.len() > 1
    }

    /// What is in the file, a line each: models, their links with masses, their joints.
    pub fn summary(&self) -> Vec<String> {
        let mut lines = vec![format!("'{}': {} models", self.name, self.models.len())];
        for robot in self.models.iter().map(|model| &model.robot) {
            lines.push(format!(
                "model '{}': {} links, {} joints",
                robot.name,
                robot.links.len(),
                robot.joints.len()
            ));
            for link in &robot.links {
                let mass = link
                    .inertial
                    .as_ref()
                    .map_or_else(|| "no mass".to_owned(), |i| format!("{} kg", i.mass));
                let (seen, touched) = (link.visuals.len(), link.collisions.len());
                lines.push(format!(
                    "  link '{}': {mass}, {seen} visuals, {touched} collisions",
                    link.name
                ));
            }
            for joint in &robot.joints {
                let [parent, child] =
                    [joint.parent, joint.child].map(|link| robot.links[link].name.as_str());
                lines.push(format!(
                    "  joint '{}' ({:?}): '{parent}' to '{child}'",
                    joint.name, joint.kind
                ));
            }
        }
        lines.extend(self.warnings.iter().cloned());
        lines
    }
}

/// What a file of any format has.
struct Contents {
    name: String,
    models: Vec<Description>,
    gravity: Option<[f64; 3]>,
}

fn read_urdf(text: &[u8]) -> Result<Parsed<Contents>, ReadError> {
    let parsed = urdf::read(text)?;
    Ok(with(parsed, |robot| Contents {
        name: robot.name.clone(),
        models: vec![Description {
            robot,
            ..Description::default()
        }],
        gravity: None,
    }))
}

fn read_sdf(
    text: &[u8],
    path: &Path,
    permissions: &Permissions,
) -> Result<Parsed<Contents>, ReadError> {
    let search = Search::beside(path).with_variables(|name| variable(name, permissions));
    let mut include = |uri: &str| included(uri, &search, permissions);
    let parsed = sdf::read(text, &mut include)?;
    Ok(with(parsed, |world| {
        let first = world
            .models
            .first()
            .map(|model| model.robot.name.clone())
            .unwrap_or_default();
        let name = if world.name.is_empty() {
            first
        } else {
            world.name
        };
        Contents {
            name,
            models: world.models.into_iter().map(of_sdf).collect(),
            gravity: world.gravity,
        }
    }))
}

/// A model of a world. What its joints fix to the world is fixed; of a static one, all is.
fn of_sdf(model: sdf::Model) -> Description {
    let sdf::Model {
        robot,
        pose,
        is_static,
    } = model;
    let is_world = |link: usize| robot.links[link].line == 0 && robot.links[link].name == "world";
    let fixed = held_links(&robot, |link| is_static || is_world(link));
    Description {
        robot,
        pose,
        fixed,
        ..Description::default()
    }
}

/// The file of an `<include>`: of a folder, that of its `model.sdf`.
fn included(uri: &str, search: &Search, permissions: &Permissions) -> Result<Included, String> {
    let may_be_read =
        |path: &Path| permissions.check_read(path).is_ok() && permissions.exists(path);
    let found = search
        .find(uri, &may_be_read)
        .map_err(|missing| missing.to_string())?;
    let file = if permissions.is_dir(&found) {
        found.join("model.sdf")
    } else {
        found
    };
    let bytes = permissions
        .read_file(&file)
        .map_err(|error| error.to_string())?;
    let folder = file
        .parent()
        .map(|folder| folder.to_string_lossy().into_owned())
        .unwrap_or_default();
    Ok(Included { bytes, folder })
}

fn read_mjcf(
    text: &[u8],
    path: &Path,
    meshes: &mut MeshFiles,
    permissions: &Permissions,
) -> Result<Parsed<Contents>, ReadError> {
    let folder = path.parent().unwrap_or(Path::new("")).to_owned();
    let parsed = mjcf::read(
        text,
        &mut Beside {
            folder,
            meshes,
            permissions,
        },
    )?;
    Ok(with(parsed, |model| {
        let name = model.robot.name.clone();
        let gravity = model.gravity;
        Contents {
            name,
            models: vec![of_mjcf(model)],
            gravity,
        }
    }))
}

fn of_mjcf(model: mjcf::Model) -> Description {
    let mjcf::Model {
        robot,
        fixed,
        actuators,
        sites,
        equalities,
        tendons,
        flexes,
        touching,
        pair_frictions,
        adhesions,
        compensations,
        moving_surfaces,
        fluid: [density, viscosity],
        ..
    } = model;
    Description {
        robot,
        fluid: Fluid { density, viscosity },
        adhesions,
        compensations,
        moving_surfaces: moving_surfaces
            .into_iter()
            .map(|(link, numbers)| (link, of_numbers(numbers)))
            .collect(),
        touching,
        pair_frictions,
        fixed,
        actuators: Some(actuators),
        sites,
        equalities,
        tendons,
        flexes,
        ..Description::default()
    }
}

fn of_numbers([x, y, z, a, b, c]: [f64; 6]) -> MovingSurface {
    MovingSurface {
        linear: [x, y, z],
        angular: [a, b, c],
    }
}

fn with<T, U>(parsed: Parsed<T>, change: impl FnOnce(T) -> U) -> Parsed<U> {
    let Parsed {
        value,
        warnings,
        further_warnings,
    } = parsed;
    Parsed {
        value: change(value),
        warnings,
        further_warnings,
    }
}

/// The files beside one in MJCF.
struct Beside<'a> {
    folder: PathBuf,
    meshes: &'a mut MeshFiles,
    permissions: &'a Permissions,
}

impl Files for Beside<'_> {
    fn include(&mut self, name: &str) -> Result<Vec<u8>, String> {
        self.permissions
            .read_file(&self.folder.join(name))
            .map_err(|error| error.to_string())
    }

    fn triangles(&mut self, file: &str) -> Result<Triangles, String> {
        let mut mesh = Triangles::default();
        for part in &self.meshes.named(file)?.parts {
            let first = numbers::count_u32(mesh.vertices.len());
            mesh.vertices.extend(part.vertices.iter().copied());
            mesh.corners.extend(
                part.triangles
                    .iter()
                    .map(|triangle| triangle.map(|corner| corner + first)),
            );
        }
        Ok(mesh)
    }
}
