//! Links become shapes: one that is touched, and one that is seen.

use geometry::MassProperties;
use robot_description::{Geometry, Inertial, Link};

use super::{Import, Node, RobotFormat, RobotImportOptions};
use scene::shape::{FLUID, Fluid, Material, RespondableMask, Shape};
use scene::{
    COLLISION_BITS, COLLISION_TREE, Data, Edit, Field, Handle, Kind, Layers, Namespace, Pose,
    SceneResult, ValueType,
};

/// Diameter of the body of a link that has mass and nothing to touch, metres.
const CARRIER: f64 = 0.05;
/// Edge and mass of what is seen of a link without any geometry, metres and kilograms.
const SPECK: (f64, f64) = (5e-4, 1e-5);
/// Inertias below are zero but for rounding, kg m²; and what stands for them.
const NO_INERTIA: f64 = 1e-15;
const SMALL_INERTIA: f64 = 1e-3;
/// The high byte: touched by all other trees. The low one: by none of its own tree, or by every second link.
const MASK: i64 = 0xff00;

impl Import<'_> {
    /// Adds all links, with the joints that they hang on, from the roots outwards.
    pub(super) fn add_links(&mut self) -> SceneResult<()> {
        self.masks = self.masks_of_touching();
        let parents = self.robot.parent_joints();
        for link in self.robot.links_from_the_roots() {
            let parent =
                parents[link].map(|joint| (joint, self.nodes[self.robot.joints[joint].parent]));
            let (joint, depth) = match parent {
                // What is fixed to something that never moves needs no force sensor.
                Some((_, node)) if self.is_fixed(link) => (node.carrier, node.depth + 1),
                Some((joint, node)) => {
                    let handle = self.add_joint(joint, node.carrier)?;
                    self.joints[joint] = Some(handle);
                    (Some(handle), node.depth + 1)
                }
                None => (None, 0),
            };
            let shape = self.add_link(link, joint, depth)?;
            if let Some(shape) = shape
                && self.begins_collision_tree(link, parent.map(|(joint, _)| joint))
            {
                let yes = (ValueType::Bool, Data::Bool(true));
                self.set_custom_data(shape, COLLISION_TREE, yes)?;
            }
            let further = self.masks.get(&link).map_or(0, |masks| masks.further);
            if let Some(shape) = shape
                && further != 0
            {
                let bits = (ValueType::Int, Data::Int(further));
                self.set_custom_data(shape, COLLISION_BITS, bits)?;
            }
            if let Some(shape) = shape
                && self.is_slowed_down(link)
            {
                let text = Data::text(&self.model.fluid.to_string());
                self.set_custom_data(shape, FLUID, (ValueType::String, text))?;
            }
            if let Some(shape) = shape {
                self.set_surface(link, shape)?;
            }
            self.nodes[link] = Node {
                carrier: shape.or(joint),
                depth,
            };
        }
        Ok(())
    }

    pub(super) fn set_custom_data(
        &mut self,
        object: Handle,
        name: &'static str,
        value: (ValueType, Data),
    ) -> SceneResult<()> {
        let edit = Edit::Name(name, Some(value));
        self.scene
            .edit_named_values(Some(object), Namespace::CustomData, edit)?;
        Ok(())
    }

    /// Whether there is a fluid, and a link has mass and moves in it.
    fn is_slowed_down(&self, link: usize) -> bool {
        let has_mass = self.robot.links[link].inertial.is_some();
        self.model.fluid != Fluid::default() && has_mass && !self.is_fixed(link)
    }

    /// Whether a link of MJCF is a tree of its own where collisions are concerned: what is fixed to the world, and what hangs on the world itself or on
    /// nothing. What hangs on another fixed body, a base, does not touch that.
    pub(super) fn begins_collision_tree(&self, link: usize, joint: Option<usize>) -> bool {
        let hangs_on_world = joint.is_none_or(|joint| self.robot.joints[joint].parent == 0);
        self.format == RobotFormat::Mjcf && (self.is_fixed(link) || hangs_on_world)
    }

    /// Adds the shapes of a link below its joint. The result is the one that carries what hangs on the link.
    fn add_link(
        &mut self,
        index: usize,
        joint: Option<Handle>,
        depth: usize,
    ) -> SceneResult<Option<Handle>> {
        let link = &self.robot.links[index];
        let (frame, hull) = (self.placed[index], self.collision_form());
        let collisions = self.shapes_of(
            link,
            link.collisions
                .iter()
                .map(|part| (part.pose, &part.geometry, None, part.line)),
            hull,
            false,
        );
        let mut touched = self.joined(collisions.clone());
        let inertial = link
            .inertial
            .clone()
            .or_else(|| self.default_inertial(index));
        if touched.is_none()
            && let Some(inertial) = &inertial
        {
            touched = Some((self.carrier_pose(inertial), super::shapes::ball(CARRIER)?));
        }
        let between = if touched.is_none() {
            self.body_between(index)?
        } else {
            None
        };
        let mut seen = self.visual(link, touched.as_ref().filter(|_| !collisions.is_empty()))?;
        let body = match touched {
            Some((pose, mut shape)) => {
                shape.dynamics.respondable = !collisions.is_empty();
                if let Some(friction) = link.friction {
                    shape.material = Material::of_friction(friction);
                }
                let by_depth = RespondableMask(MASK | self.local_mask(depth));
                shape.dynamics.respondable_mask =
                    self.masks.get(&index).map_or(by_depth, |masks| masks.mask);
                self.set_inertia(index, inertial.as_ref(), pose, &mut shape);
                Some(self.add_body(&link.name, frame * pose, shape, joint)?)
            }
            None => match between {
                Some((pose, shape)) => {
                    Some(self.add_body(&link.name, frame * pose, shape, joint)?)
                }
                None => None,
            },
        };
        if seen.is_none()
            && body.is_none()
            && self.options.contains(RobotImportOptions::CREATE_VISUALS)
        {
            let mut speck = super::shapes::cube(SPECK.0)?;
            speck.mass.set_mass(SPECK.1);
            seen = Some((Pose::identity(), speck));
        }
        let Some((pose, shape)) = seen else {
            return Ok(body);
        };
        let visual = self.add(
            &format!("{}_visual", link.name),
            Kind::Shape(Box::new(shape)),
            frame * pose,
            body.or(joint),
        )?;
        Ok(body.or(Some(visual)))
    }

    /// What is seen of a link: its visuals, or a copy of what is touched.
    fn visual(
        &mut self,
        link: &Link,
        touched: Option<&(Pose, Shape)>,
    ) -> SceneResult<Option<(Pose, Shape)>> {
        let robot = self.robot;
        let visuals = link.visuals.iter().map(|part| {
            (
                part.pose,
                &part.geometry,
                robot.material_of(part),
                part.line,
            )
        });
        let shapes = self.shapes_of(link, visuals, super::shapes::Form::AsItIs, true);
        let own = self.joined(shapes);
        let copies = self.options.contains(RobotImportOptions::CREATE_VISUALS);
        Ok(own.or_else(|| touched.filter(|_| copies).cloned()))
    }

    fn carrier_pose(&self, inertial: &Inertial) -> Pose {
        if self.options.contains(RobotImportOptions::FRAMES_AT_JOINTS) {
            return Pose::identity();
        }
        inertial.pose.translation.into()
    }

    /// Adds the shape that has the mass of a link.
    fn add_body(
        &mut self,
        link: &str,
        pose: Pose,
        shape: Shape,
        joint: Option<Handle>,
    ) -> SceneResult<Handle> {
        let body = self.add(
            &format!("{link}_respondable"),
            Kind::Shape(Box::new(shape)),
            pose,
            joint,
        )?;
        if !self.options.contains(RobotImportOptions::SHOW_COLLISIONS) {
            self.scene.modify(body, Field::Layer, |object| {
                object.layer = Layers::SHAPES.hidden();
            })?;
        }
        Ok(body)
    }

    fn local_mask(&self, depth: usize) -> i64 {
        match (
            self.options.contains(RobotImportOptions::ALTERNATE_MASKS),
            depth % 2,
        ) {
            (false, _) => 0,
            (true, 0) => 1,
            (true, _) => 2,
        }
    }

    /// A link without inertia is static, unless its format says otherwise. `pose` is that of the shape in the link's frame.
    fn set_inertia(
        &mut self,
        index: usize,
        inertial: Option<&Inertial>,
        pose: Pose,
        shape: &mut Shape,
    ) {
        let link = &self.robot.links[index];
        let is_fixed = self.is_fixed(index);
        shape.dynamics.is_static =
            is_fixed || inertial.is_none() && self.format != RobotFormat::Mjcf;
        match inertial {
            Some(inertial) => self.set_mass(
                link,
                inertial,
                pose.inverse() * inertial.pose,
                &mut shape.mass,
            ),
            None if is_fixed => {}
            None if shape.dynamics.is_static => {
                self.message(format!("link '{}' has no inertia: it is static", link.name));
            }
            None => self.set_small_mass(index, shape),
        }
    }

    /// A link of MJCF without mass that moves is fixed to one that has some: it gets so little that it does not count.
    fn set_small_mass(&mut self, index: usize, shape: &mut Shape) {
        let Some(next) = self.inertial_above(index) else {
            return self.message(format!(
                "link '{}' has no mass: that of its shape is taken",
                self.robot.links[index].name
            ));
        };
        shape.mass = self.small_mass(Some(next));
    }

    /// Mass and inertia as the file says, where they are possible.
    fn set_mass(
        &mut self,
        link: &Link,
        inertial: &Inertial,
        in_shape: Pose,
        mass: &mut MassProperties,
    ) {
        if inertial.mass > 0.0 {
            mass.set_mass(inertial.mass);
        } else {
            self.message(format!(
                "link '{}' has no mass: that of its shape is taken",
                link.name
            ));
        }
        let [mut xx, xy, xz, mut yy, yz, mut zz] = inertial.inertia;
        if inertial
            .inertia
            .iter()
            .all(|number| number.abs() < NO_INERTIA)
        {
            (xx, yy, zz) = (SMALL_INERTIA, SMALL_INERTIA, SMALL_INERTIA);
            self.message(format!(
                "link '{}' has no inertia: {SMALL_INERTIA} is taken",
                link.name
            ));
        }
        let frame = geometry::pose::pose_to_matrix(&in_shape);
        mass.set_absolute_inertia(&[xx, xy, xz, xy, yy, yz, xz, yz, zz], &frame);
    }

    fn collision_form(&self) -> super::shapes::Form {
        use super::shapes::Form;
        // MuJoCo lets the hulls of meshes touch.
        if self.format == RobotFormat::Mjcf
            || self
                .options
                .contains(RobotImportOptions::HULLS_OF_COLLISIONS)
        {
            Form::Hull
        } else if self
            .options
            .contains(RobotImportOptions::DECOMPOSE_COLLISIONS)
        {
            Form::Pieces
        } else {
            Form::AsItIs
        }
    }
}

/// A geometry of a link: its pose in the link's frame, how it looks, its line.
pub(super) type Part<'a> = (
    Pose,
    &'a Geometry,
    Option<&'a robot_description::Material>,
    u32,
);
