//! A robot together with what it has to do with ROS 2: from its description, the parameters of its controllers, and a TOML file.

use std::path::{Path, PathBuf};

use robot_description::ros::{self, Interface};
use robot_description::{Parsed, Robot, Search};

use super::mesh_files::variable;
use super::{RobotFile, RobotFormat};
use permissions::Permissions;

/// The ending of the TOML file beside a description or a scene.
const BESIDE: &str = "ros2.toml";

/// What files say of a robot.
#[derive(Debug, Default)]
pub struct RosRobot {
    /// Its links and joints; None if its file is no description.
    pub robot: Option<Robot>,
    /// The text of a URDF.
    pub urdf: Option<Vec<u8>>,
    /// Its sensors and controllers.
    pub interface: Interface,
    /// Whether any file says something about ROS 2.
    pub is_described: bool,
    /// What was not understood, a line each, with file and line.
    pub problems: Vec<String>,
}

impl RosRobot {
    /// Reads a description or names a scene, and the TOML file `settings`, or the one beside it.
    ///
    /// # Errors
    /// When the description or the settings may not or cannot be read; in words.
    pub fn read(
        path: &Path,
        settings: Option<&Path>,
        permissions: &Permissions,
    ) -> Result<Self, String> {
        let mut read = Self::default();
        if RobotFile::is_one(path, permissions) {
            read.read_description(path, permissions)?;
        }
        let beside = path.with_extension(BESIDE);
        let settings = match settings {
            None if may_be_read(&beside, permissions) => Some(beside.as_path()),
            settings => settings,
        };
        if let Some(settings) = settings {
            read.read_settings(settings, permissions)?;
        }
        read.read_parameters(settings.unwrap_or(path), permissions);
        read.finish(path);
        Ok(read)
    }

    fn read_description(&mut self, path: &Path, permissions: &Permissions) -> Result<(), String> {
        let file = RobotFile::read(path, permissions)?;
        let bytes = permissions
            .read_file(path)
            .map_err(|error| error.to_string())?;
        let parsed = match file.format {
            RobotFormat::Urdf => ros::of_urdf(&bytes),
            RobotFormat::Sdf => ros::of_sdf(&bytes),
            RobotFormat::Mjcf => Ok(Parsed {
                value: Interface::default(),
                warnings: Vec::new(),
                further_warnings: 0,
            }),
        };
        let parsed = parsed.map_err(|error| error.to_string())?;
        let moves = |robot: &Robot| robot.joints.iter().any(|joint| joint.kind.numbers() > 0);
        // A box of URDF is no robot.
        self.is_described = parsed.value != Interface::default()
            || file.format == RobotFormat::Urdf
                && file.models.iter().any(|model| moves(&model.robot));
        self.interface = self.noted(path, parsed);
        self.urdf = (file.format == RobotFormat::Urdf).then_some(bytes);
        self.robot = file.models.into_iter().next().map(|model| model.robot);
        Ok(())
    }

    fn read_settings(&mut self, path: &Path, permissions: &Permissions) -> Result<(), String> {
        let bytes = permissions
            .read_file(path)
            .map_err(|error| format!("{}: {error}", path.display()))?;
        match ros::of_toml(&bytes) {
            Ok(parsed) => {
                let settings = self.noted(path, parsed);
                self.interface.extend(settings);
            }
            Err(problem) => return Err(format!("{}: {problem}", path.display())),
        }
        self.is_described = true;
        Ok(())
    }

    /// The controllers of files of parameters; without any, those that are usual.
    fn read_parameters(&mut self, beside: &Path, permissions: &Permissions) {
        let mut has_read = false;
        for (name, line) in std::mem::take(&mut self.interface.parameter_files) {
            let found = parameter_file(&name, beside, permissions);
            let bytes = found.and_then(|file| {
                let bytes = permissions
                    .read_file(&file)
                    .map_err(|error| error.to_string())?;
                Ok((file, bytes))
            });
            match bytes {
                Ok((file, bytes)) => {
                    let controllers = self.noted(&file, ros::of_yaml(&bytes));
                    self.interface.extend(controllers);
                    has_read = true;
                }
                Err(reason) => self
                    .problems
                    .push(format!("line {line}, <parameters>: {reason}")),
            }
        }
        if !has_read {
            self.interface.add_usual_controllers();
        }
    }

    /// Takes what was read of a file, and notes what was wrong in it.
    fn noted<T>(&mut self, file: &Path, parsed: Parsed<T>) -> T {
        let name = file
            .file_name()
            .map(|name| name.to_string_lossy().into_owned());
        let name = name.unwrap_or_default();
        let lines = parsed
            .warnings
            .iter()
            .map(|warning| format!("{name}: {warning}"));
        self.problems.extend(lines);
        if parsed.further_warnings > 0 {
            self.problems
                .push(format!("{name}: and {} others", parsed.further_warnings));
        }
        parsed.value
    }

    fn finish(&mut self, path: &Path) {
        if let Some(robot) = &self.robot {
            let fitting = std::mem::take(&mut self.interface).fitting(robot);
            self.interface = self.noted(path, fitting);
        }
    }
}

fn may_be_read(path: &Path, permissions: &Permissions) -> bool {
    permissions.check_read(path).is_ok() && permissions.is_file(path)
}

/// A file of parameters: where its name says, as file of a package, or of that name beside the description or in `config` there or beside.
fn parameter_file(
    name: &str,
    description: &Path,
    permissions: &Permissions,
) -> Result<PathBuf, String> {
    let exists = |path: &Path| may_be_read(path, permissions);
    let uri = match name
        .strip_prefix("$(find ")
        .and_then(|rest| rest.split_once(')'))
    {
        Some((package, rest)) => format!("package://{package}{rest}"),
        None => name.to_owned(),
    };
    let search = Search::beside(description).with_variables(|name| variable(name, permissions));
    let short = Path::new(name).file_name().unwrap_or_default();
    let folder = description.parent().unwrap_or(Path::new(""));
    let near = ["", "config", "../config"].map(|between| folder.join(between).join(short));
    search.find(&uri, &exists).or_else(|missing| {
        let found = near.into_iter().find(|path| exists(path));
        found.ok_or_else(|| missing.to_string())
    })
}
