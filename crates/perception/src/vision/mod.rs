//! Pictures of the scene: which objects are seen, what they look like, and what lights them. The drawing itself is in the crate
//! `rendering`.

mod drawings;
mod lighting;
mod models;
mod palette;
mod projection;
mod sensors;
mod spares;
mod subjects;
mod surfaces;
#[cfg(test)]
mod tests;
mod views;
mod voxels;

use std::num::NonZero;
use std::thread::available_parallelism;

use rendering::{Camera, Fog, Instance, Lines, Material, Points, Projection, Renderer, World};

use models::{Model, Models};
use scene::sensor::View;
use scene::{Handle, Pose, Scene};
use spares::Spares;

pub use drawings::item_colour;
pub use lighting::{Backdrop, views_background};
pub use rendering::{Channels, Picture};
pub use sensors::SensorPicture;
pub(crate) use subjects::Subjects;
pub use surfaces::texture_coordinates;
pub use views::{Viewpoint, first_camera, projection};

/// Draws pictures of a scene, with cached data of its objects.
#[derive(Default)]
pub struct Vision {
    /// None before the first picture.
    renderer: Option<Renderer>,
    /// None for as many as there are processor cores.
    threads: Option<NonZero<usize>>,
    models: Models,
    spares: Spares,
}

/// Content and viewpoint of a picture.
#[derive(Debug, Clone)]
pub struct Shot {
    /// The camera or vision sensor; none for a view from elsewhere.
    pub viewer: Option<Handle>,
    /// In the world.
    pub pose: Pose,
    /// Projection, clipping planes and resolution.
    pub view: View,
    /// The objects that can be seen.
    pub subjects: Subjects,
    /// What the colours of the picture mean.
    pub colour_mode: ColourMode,
    /// What is seen where no object is.
    pub backdrop: Backdrop,
    /// Whether the fog of the scene is drawn.
    pub has_fog: bool,
    /// Whether surfaces have highlights.
    pub has_specular: bool,
    /// Only lights below this object shine.
    pub lit_by: Option<Handle>,
}

/// Meaning of the colours of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColourMode {
    /// Surfaces as the lights show them.
    Lit {
        /// Whether lights that cast shadows do.
        shadows: bool,
    },
    /// The auxiliary colours of the objects, unlit.
    Auxiliary,
}

impl Vision {
    /// Draws with so many threads at most; None for as many as there are processor cores. Pictures do not depend on it.
    pub(crate) fn new(threads: Option<NonZero<usize>>) -> Self {
        Self {
            threads,
            ..Self::default()
        }
    }

    /// Takes the memory of pictures that are no longer needed, for those to come.
    pub fn reuse(&mut self, colours: Vec<u8>, depths: Vec<f32>) {
        self.spares.keep(colours, depths);
    }

    /// A picture of the scene; its ids are handles of objects.
    pub fn picture(&mut self, scene: &Scene, shot: &Shot, channels: Channels) -> Picture {
        self.models.follow(scene);
        let subjects = shot.subjects.objects(scene, shot.viewer);
        let depth_apart = channels.depth && subjects.iter().any(|subject| subject.depth_invisible);
        let all: Vec<Handle> = subjects.iter().map(|subject| subject.handle).collect();
        if !depth_apart {
            return self.draw(scene, shot, &all, channels);
        }
        let solid: Vec<Handle> = subjects
            .iter()
            .filter(|s| !s.depth_invisible)
            .map(|s| s.handle)
            .collect();
        let mut picture = self.draw(
            scene,
            shot,
            &all,
            Channels {
                depth: false,
                ..channels
            },
        );
        picture.depth = self.draw(scene, shot, &solid, Channels::DEPTH).depth;
        picture
    }

    fn draw(
        &mut self,
        scene: &Scene,
        shot: &Shot,
        objects: &[Handle],
        channels: Channels,
    ) -> Picture {
        self.models.prepare(scene, objects);
        // They are no objects of the scene: where only these count, they hide none.
        let only_ids = channels == Channels::IDS;
        let drawings = if only_ids {
            Vec::new()
        } else {
            drawings::visible(scene, shot)
        };
        let mut stage = Stage::default();
        for &handle in objects {
            if let (Some(model), Ok(pose)) = (self.models.get(handle), scene.world_pose(handle)) {
                stage.add(model, handle.0, pose, shot.colour_mode);
            }
        }
        drawings.iter().for_each(|drawing| {
            stage.add(&drawing.model, drawing.id, drawing.pose, shot.colour_mode);
        });
        let lights = lighting::lights(scene, shot);
        let (points, lines) = (&stage.points[..], &stage.lines[..]);
        let world = World {
            instances: &stage.instances,
            points,
            lines,
            lights: &lights,
            ambient: lighting::ambient(scene, shot.colour_mode),
            fog: fog(scene, shot),
            background: shot.backdrop.colours(scene),
            shadows: shot.colour_mode == ColourMode::Lit { shadows: true },
        };
        let renderer = self
            .renderer
            .get_or_insert_with(|| Renderer::new(threads(self.threads)));
        let camera = camera(shot);
        let mut picture = self.spares.picture(camera.resolution, channels);
        renderer.render_into(&world, &camera, channels, &mut picture);
        picture
    }
}

fn threads(wanted: Option<NonZero<usize>>) -> usize {
    wanted
        .or_else(|| available_parallelism().ok())
        .map_or(1, NonZero::get)
}

fn fog(scene: &Scene, shot: &Shot) -> Option<Fog> {
    let lit = matches!(shot.colour_mode, ColourMode::Lit { .. });
    (lit && shot.has_fog)
        .then(|| lighting::fog(&scene.settings().environment.fog))
        .flatten()
}

fn camera(shot: &Shot) -> Camera {
    let view = &shot.view;
    let projection = match view.perspective {
        true => Projection::Perspective { angle: view.angle },
        false => Projection::Orthographic {
            size: view.ortho_size,
        },
    };
    Camera {
        pose: shot.pose,
        projection,
        near: view.clipping[0],
        far: view.clipping[1],
        resolution: view.resolution,
    }
}

/// Everything that is drawn in one picture.
#[derive(Default)]
struct Stage<'a> {
    instances: Vec<Instance<'a>>,
    points: Vec<Points<'a>>,
    lines: Vec<Lines<'a>>,
}

impl<'a> Stage<'a> {
    fn add(&mut self, model: &'a Model, id: u32, pose: Pose, colour_mode: ColourMode) {
        let material = |part: &'a models::ModelPart| -> &'a Material {
            if colour_mode == ColourMode::Auxiliary {
                &part.auxiliary
            } else {
                &part.material
            }
        };
        self.instances
            .extend(model.parts.iter().map(|part| Instance {
                mesh: &part.mesh,
                pose: pose * part.pose,
                material: material(part),
                id,
            }));
        self.points.extend(model.points.iter().map(|points| Points {
            positions: &points.positions,
            colours: if colour_mode == ColourMode::Auxiliary {
                &points.auxiliary
            } else {
                &points.colours
            },
            pose,
            size: points.size,
            id,
            overlay: points.overlay,
        }));
        self.lines.extend(model.lines.iter().map(|lines| Lines {
            segments: &lines.segments,
            colours: if colour_mode == ColourMode::Auxiliary {
                &lines.auxiliary
            } else {
                &lines.colours
            },
            pose,
            width: lines.width,
            id,
            overlay: lines.overlay,
        }));
    }
}
