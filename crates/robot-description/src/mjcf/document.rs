//! What is said once for a whole file: settings, defaults, assets.

use std::collections::BTreeMap;

use super::attributes::{Defaults, MAIN};
use super::element::{Element, Report};
use super::mesh_solid::Volume;
use super::orientation;
use crate::model::{Material, Pose};
use crate::xml::short;

/// Parts of a file that this reader looks at, and those that say nothing about bodies.
const READ: &[&str] = &[
    "compiler",
    "default",
    "asset",
    "worldbody",
    "actuator",
    "tendon",
    "contact",
    "equality",
    "option",
];
const IRRELEVANT: &[&str] = &["visual", "statistic", "size", "custom"];

/// The settings, defaults and assets of a file.
#[derive(Debug)]
pub struct Document {
    pub settings: Settings,
    pub defaults: Defaults,
    pub meshes: BTreeMap<String, MeshAsset>,
    materials: BTreeMap<String, Material>,
    pub gravity: Option<[f64; 3]>,
    /// Density (kg/m³) and viscosity (Pa s) of the fluid that all bodies are in.
    pub fluid: [f64; 2],
}

/// The settings of `<compiler>`.
#[derive(Debug)]
pub struct Settings {
    is_radian: bool,
    /// The axes of Euler angles, as letters.
    pub sequence: [u8; 3],
    mesh_folder: String,
    texture_folder: String,
    strips_path: bool,
    pub limits_by_range: bool,
    pub inertia_from_geoms: FromGeoms,
    pub inertia_groups: [f64; 2],
    pub least_mass: f64,
    pub least_inertia: f64,
    pub balances_inertia: bool,
    pub total_mass: Option<f64>,
}

/// Which bodies have the mass of their geoms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FromGeoms {
    All,
    WithoutInertial,
    None,
}

/// A mesh that geoms name.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshAsset {
    pub file: String,
    pub scale: [f64; 3],
    /// The frame in the file's frame that its coordinates are taken in.
    pub reference: Pose,
    pub volume: Volume,
}

impl Settings {
    /// An angle as the file writes it, in radians.
    pub fn angle(&self, angle: f64) -> f64 {
        if self.is_radian {
            angle
        } else {
            angle.to_radians()
        }
    }

    /// Angles are in radians from now on.
    pub fn use_radians(&mut self) {
        self.is_radian = true;
    }

    fn new(root: &Element, report: &mut Report) -> Self {
        let mut settings = Self {
            is_radian: false,
            sequence: *b"xyz",
            mesh_folder: String::new(),
            texture_folder: String::new(),
            strips_path: false,
            limits_by_range: true,
            inertia_from_geoms: FromGeoms::WithoutInertial,
            inertia_groups: [0.0, 5.0],
            least_mass: 0.0,
            least_inertia: 0.0,
            balances_inertia: false,
            total_mass: None,
        };
        for element in root.named("compiler") {
            settings.add(element, report);
        }
        settings
    }

    fn add(&mut self, element: &Element, report: &mut Report) {
        for (name, text) in &element.attributes {
            let is_true = text == "true";
            let number = |report: &mut Report| report.numbers(element, name, text).first().copied();
            match name.as_str() {
                "angle" => self.is_radian = text == "radian",
                "eulerseq" => self.set_sequence(element, text, report),
                "assetdir" => {
                    (self.mesh_folder, self.texture_folder) = (text.clone(), text.clone());
                }
                "meshdir" => self.mesh_folder.clone_from(text),
                "texturedir" => self.texture_folder.clone_from(text),
                "strippath" => self.strips_path = is_true,
                "autolimits" => self.limits_by_range = is_true,
                "inertiafromgeom" => self.inertia_from_geoms = from_geoms(text),
                "inertiagrouprange" => {
                    if let [low, high] = report.numbers(element, name, text)[..] {
                        self.inertia_groups = [low, high];
                    }
                }
                "boundmass" => self.least_mass = number(report).unwrap_or(0.0),
                "boundinertia" => self.least_inertia = number(report).unwrap_or(0.0),
                "balanceinertia" => self.balances_inertia = is_true,
                "settotalmass" => self.total_mass = number(report).filter(|mass| *mass > 0.0),
                "coordinate" if text == "global" => {
                    report.leave_out(element, "global coordinates are not read");
                }
                "fitaabb" if is_true => {
                    report.leave_out(element, "primitives are not fitted to meshes");
                }
                _ => {}
            }
        }
    }

    fn set_sequence(&mut self, element: &Element, text: &str, report: &mut Report) {
        match text.as_bytes() {
            [a, b, c] if [a, b, c].iter().all(|letter| b"xyzXYZ".contains(letter)) => {
                self.sequence = [*a, *b, *c];
            }
            _ => report.warn(
                element,
                format!("eulerseq '{}' is no sequence of axes", short(text)),
            ),
        }
    }

    /// The name of a file of a mesh, relative to the folder of the model.
    pub fn mesh_file(&self, name: &str) -> String {
        self.file(&self.mesh_folder, name)
    }

    /// The name of a file, relative to the folder of the model.
    fn file(&self, folder: &str, name: &str) -> String {
        let name = if self.strips_path {
            name.rsplit(['/', '\\']).next().unwrap_or(name)
        } else {
            name
        };
        if folder.is_empty() || name.starts_with('/') {
            return name.to_owned();
        }
        format!("{}/{name}", folder.trim_end_matches('/'))
    }
}

fn from_geoms(text: &str) -> FromGeoms {
    match text {
        "true" => FromGeoms::All,
        "false" => FromGeoms::None,
        _ => FromGeoms::WithoutInertial,
    }
}

impl Document {
    pub fn new(root: &Element, report: &mut Report) -> Self {
        for part in root
            .children
            .iter()
            .filter(|part| !IRRELEVANT.contains(&part.name.as_str()))
        {
            if !READ.contains(&part.name.as_str()) {
                report.leave_out(part, format!("<{}> is not read", short(&part.name)));
            }
        }
        let mut document = Self {
            settings: Settings::new(root, report),
            defaults: Defaults::new(root, report),
            meshes: BTreeMap::new(),
            materials: BTreeMap::new(),
            gravity: None,
            fluid: [0.0; 2],
        };
        document.add_assets(root, report);
        for option in root.named("option") {
            let attributes = document.defaults.of(option, MAIN, report);
            let gravity = option.attribute("gravity").is_some();
            document.gravity = gravity
                .then(|| attributes.numbers(report, "gravity", [0.0, 0.0, -9.81]))
                .or(document.gravity);
            let flags = option.named("flag");
            for flag in flags.filter_map(|flag| flag.attribute("gravity")) {
                let is_off = flag == "disable";
                document.gravity = is_off.then_some([0.0; 3]).or(document.gravity);
            }
            for (number, name) in ["density", "viscosity"].into_iter().enumerate() {
                let said = attributes.number(report, name);
                document.fluid[number] = said.unwrap_or(document.fluid[number]);
            }
            if attributes.get("wind").is_some() {
                report.leave_out(option, "wind is not read");
            }
        }
        document
    }

    fn add_assets(&mut self, root: &Element, report: &mut Report) {
        let mut textures = BTreeMap::new();
        for asset in root.named("asset").flat_map(|part| &part.children) {
            match asset.name.as_str() {
                "mesh" => self.add_mesh(asset, report),
                "texture" => {
                    if let Some(file) = asset.attribute("file") {
                        let name = asset.attribute("name").unwrap_or_else(|| stem(file));
                        textures.insert(
                            name.to_owned(),
                            self.settings.file(&self.settings.texture_folder, file),
                        );
                    }
                }
                "material" => {}
                other => report.leave_out(asset, format!("<{}> is not read", short(other))),
            }
        }
        for asset in root.named("asset").flat_map(|part| part.named("material")) {
            let attributes = self.defaults.of(asset, MAIN, report);
            let name = asset.attribute("name").unwrap_or_default().to_owned();
            let color = attributes
                .get("rgba")
                .map(|_| attributes.numbers(report, "rgba", [1.0; 4]));
            let texture = attributes
                .get("texture")
                .and_then(|name| textures.get(name))
                .cloned();
            self.materials.insert(
                name.clone(),
                Material {
                    name,
                    color,
                    texture,
                },
            );
        }
    }

    fn add_mesh(&mut self, asset: &Element, report: &mut Report) {
        let attributes = self.defaults.of(asset, MAIN, report);
        let Some(file) = attributes.get("file") else {
            return report.leave_out(asset, "a mesh without a file is not read");
        };
        let name = asset
            .attribute("name")
            .unwrap_or_else(|| stem(file))
            .to_owned();
        let scale = attributes.numbers(report, "scale", [1.0; 3]);
        let position = attributes.numbers(report, "refpos", [0.0; 3]);
        let [w, x, y, z] = attributes.numbers(report, "refquat", [1.0, 0.0, 0.0, 0.0]);
        let rotation =
            nalgebra::UnitQuaternion::try_new(nalgebra::Quaternion::new(w, x, y, z), 1e-12);
        let reference = Pose::from_parts(
            nalgebra::Vector3::from(position).into(),
            rotation.unwrap_or_default(),
        );
        let file = self.settings.mesh_file(file);
        let volume = match attributes.get("inertia") {
            Some("exact") => Volume::Exact,
            None | Some("legacy") => Volume::Legacy,
            Some(other) => {
                report.warn(
                    asset,
                    format!(
                        "the volume of meshes '{}' is not computed: the legacy one is",
                        short(other)
                    ),
                );
                Volume::Legacy
            }
        };
        self.meshes.insert(
            name,
            MeshAsset {
                file,
                scale,
                reference,
                volume,
            },
        );
    }

    /// The pose of an element of the model.
    pub fn pose(&self, attributes: &super::attributes::Attributes, report: &mut Report) -> Pose {
        orientation::pose(attributes, &self.settings, report)
    }

    /// The appearance that the attributes name: a material, or a colour.
    pub fn material(
        &self,
        attributes: &super::attributes::Attributes,
        report: &mut Report,
    ) -> Option<Material> {
        let named = attributes
            .get("material")
            .and_then(|name| self.materials.get(name))
            .cloned();
        let color = attributes
            .get("rgba")
            .map(|_| attributes.numbers(report, "rgba", [0.5, 0.5, 0.5, 1.0]));
        match (named, color) {
            (None, None) => None,
            (named, color) => {
                let mut material = named.unwrap_or_default();
                material.color = color.or(material.color);
                Some(material)
            }
        }
    }
}

/// The name of a file without folder and ending.
fn stem(file: &str) -> &str {
    let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}
