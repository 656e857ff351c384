//! Soft things of MJCF as shapes.

use nalgebra::{Point3, Vector3};
use robot_description::mjcf::{Flex, FlexForm};

use super::Import;
use scene::shape::soft::body::Body;
use scene::shape::soft::rope::Rope;
use scene::shape::soft::{Pin, Soft};
use scene::shape::{Appearance, Material, RespondableMask, Shape};
use scene::{COLLISION_TREE, Data, Handle, Kind, Pose, Scene, SceneResult, ValueType};

/// The colour of what has none in the file.
const COLOR: [f32; 3] = [0.5, 0.5, 0.5];

/// A soft thing, ready to be added to a scene with the pose of what it is on.
#[derive(Debug)]
pub struct SoftShape {
    /// What it is.
    pub soft: Soft,
    /// How it begins.
    pub shape: Shape,
}

impl SoftShape {
    /// What a description of MJCF becomes.
    ///
    /// # Errors
    /// When the physics cannot compute with it; in words.
    pub fn new(flex: &Flex) -> Result<Self, String> {
        let soft = soft(flex);
        let fault = match &soft {
            Soft::Rope(rope) if !rope.is_valid() => Some("a number is out of range"),
            Soft::Rope(_) => None,
            Soft::Body(body) => body.fault(),
        };
        if let Some(fault) = fault {
            return Err(fault.to_owned());
        }
        let color = flex
            .color
            .map_or(COLOR, |[r, g, b, _]| [r, g, b].map(numbers::single));
        let shape = Shape::of_soft(&soft, Appearance::new(color));
        let mut shape = shape.map_err(|error| error.to_string())?;
        shape.material = Material::of_friction(flex.friction);
        shape.mass.mass = flex.mass;
        shape.dynamics.respondable = flex.touches;
        Ok(Self { soft, shape })
    }

    /// The same that touches only what the mask says.
    #[must_use]
    pub fn with_mask(mut self, mask: i64) -> Self {
        self.shape.dynamics.respondable_mask = RespondableMask(mask);
        self
    }
}

fn soft(flex: &Flex) -> Soft {
    let body = Body {
        radius: flex.radius,
        damping: flex.damping,
        drag: flex.drag,
        strength: f64::INFINITY,
        flat: true,
        touches_itself: flex.touches_itself,
        points: flex.points.clone(),
        ..Body::default()
    };
    let body = match &flex.form {
        FlexForm::Line {
            stretch,
            bend,
            twist,
            straight,
        } => return Soft::Rope(rope(flex, [*stretch, *bend, *twist], *straight)),
        FlexForm::Sheet {
            triangles,
            stretch,
            bend,
            poisson,
        } => Body {
            triangles: triangles.clone(),
            stretch: *stretch,
            bend: *bend,
            poisson: *poisson,
            ..body
        },
        FlexForm::Solid {
            triangles,
            tetrahedra,
            young,
            poisson,
        } => Body {
            triangles: triangles.clone(),
            tetrahedra: tetrahedra.clone(),
            young: *young,
            poisson: *poisson,
            flat: false,
            ..body
        },
    };
    let density = flex.mass / body.extent();
    Soft::Body(Body { density, ..body })
}

fn rope(flex: &Flex, [stretch, bend, twist]: [f64; 3], straight: bool) -> Rope {
    let pairs = flex.points.windows(2);
    let lengths = pairs.map(|pair| (Vector3::from(pair[1]) - Vector3::from(pair[0])).norm());
    Rope {
        radius: flex.radius,
        line_density: flex.mass / lengths.sum::<f64>(),
        stretch,
        bend,
        twist,
        damping: flex.damping,
        drag: flex.drag,
        strength: f64::INFINITY,
        length: 0.0,
        straight,
        touches_itself: flex.touches_itself,
        points: flex.points.clone(),
    }
}

/// Lets an object hold the pinned nodes of a soft thing; without one, the world does. `frame` is what the nodes are in.
///
/// # Errors
/// When an object is gone.
pub fn pin_nodes(
    scene: &mut Scene,
    shape: Handle,
    flex: &Flex,
    holder: Option<Handle>,
    frame: Pose,
) -> SceneResult<()> {
    let base = match holder {
        Some(holder) => scene.world_pose(holder)?,
        None => Pose::identity(),
    };
    let into = base.inverse() * frame;
    let pins = flex.pins.iter().map(|pin| Pin {
        point: pin.node,
        holder,
        place: (into * Point3::from(flex.points[pin.node])).into(),
        clamped: pin.clamped,
    });
    scene.set_pins(shape, &pins.collect::<Vec<Pin>>())
}

impl Import<'_> {
    /// Adds the soft things, below the links that they are on.
    pub(super) fn add_flexes(&mut self) -> SceneResult<()> {
        for flex in &self.model.flexes {
            let made = match SoftShape::new(flex) {
                Ok(made) => made,
                Err(reason) => {
                    self.message(format!("line {}: '{}': {reason}", flex.line, flex.name));
                    continue;
                }
            };
            let carrier = self.nodes[flex.link].carrier;
            let frame = self.placed[flex.link];
            let alias = if flex.name.is_empty() {
                "flex"
            } else {
                &flex.name
            };
            let kind = Kind::Shape(Box::new(made.shape));
            let shape = self.add(alias, kind, frame, carrier)?;
            self.scene.set_soft(shape, &made.soft)?;
            pin_nodes(self.scene, shape, flex, carrier, frame)?;
            // It touches the ground that it hangs on in the tree; not what moves and carries it.
            if self.is_fixed(flex.link) {
                let yes = (ValueType::Bool, Data::Bool(true));
                self.set_custom_data(shape, COLLISION_TREE, yes)?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use permissions::Permissions;

    use super::*;
    use crate::robot_file::{RobotFile, RobotFormat, RobotImportOptions};

    fn imported(text: &str) -> (Scene, Vec<String>) {
        let path = Path::new("/nowhere/robot.xml");
        let permissions = Permissions::none();
        let file = RobotFile::parse(text.as_bytes(), RobotFormat::Mjcf, path, None, &permissions);
        let mut scene = Scene::new();
        let imported = file
            .expect("it is a model")
            .add_to(&mut scene, RobotImportOptions::KEEP_POSITION)
            .expect("there are handles enough");
        (scene, imported.messages)
    }

    fn named<'a>(scene: &'a Scene, name: &str) -> &'a scene::Object {
        let mut objects = scene.objects();
        objects
            .find(|object| object.alias() == name)
            .expect("it was imported")
    }

    #[test]
    fn a_flexcomp_hangs_below_its_body_and_a_cable_in_the_world() {
        let (scene, messages) = imported(
            "<mujoco><worldbody><body name='base' pos='0 0 1'><geom size='0.1'/>
            <flexcomp name='net' count='3 3 1' spacing='0.1 0.1 0.1' pos='0.5 0 0' mass='0.9'>
            <edge equality='true'/><contact contype='0' conaffinity='0'/><pin id='0'/></flexcomp></body>
            <composite prefix='hose' type='cable' count='4 1 1' offset='0 0 2'><geom size='.01' rgba='1 0 0 1'/></composite>
            </worldbody></mujoco>",
        );
        assert_eq!(messages, [""; 0]);
        let hose = named(&scene, "hose");
        assert!(hose.custom_data.typed(COLLISION_TREE).is_some());
        let net = named(&scene, "net");
        assert!(net.custom_data.typed(COLLISION_TREE).is_some());
        let base = net.parent().expect("it is on the body");
        let place = scene
            .world_pose(base)
            .expect("it is there")
            .translation
            .vector;
        assert!((place.z - 1.0).abs() < 1e-9, "{place}");
        let [pin] = net.pins()[..] else {
            panic!("there is one pin: {:?}", net.pins());
        };
        assert_eq!((pin.point, pin.holder, pin.clamped), (0, Some(base), false));
        let form = scene.soft_form(net.handle()).expect("it is soft");
        let error = Vector3::from(form.points[0]) - Vector3::new(0.4, -0.1, 1.0);
        assert!(error.norm() < 1e-9, "{:?}", form.points[0]);
        let shape = net.shape().expect("it is a shape");
        assert!(!shape.dynamics.respondable && (shape.mass.mass - 0.9).abs() < 1e-12);
        let hose = named(&scene, "hose");
        assert!(matches!(hose.soft(), Some(Soft::Rope(rope)) if rope.points.len() == 4));
        assert!(hose.pins()[0].holder.is_none() && hose.pins()[0].clamped);
    }

    /// Soft things of the world are a tree of their own for masks, so that the ground of the file stops them.
    #[test]
    fn what_hangs_on_nothing_that_moves_touches_the_ground() {
        let soft = "<flexcomp name='NAME' type='box' count='3 3 3' mass='1'><edge equality='true'/></flexcomp>";
        let [free, carried] = ["free", "carried"].map(|name| soft.replace("NAME", name));
        let (scene, messages) = imported(&format!(
            "<mujoco><worldbody><geom type='plane' size='1 1 1'/><body>{free}</body><body name='cart'><freejoint/><geom size='0.1'/>{carried}</body></worldbody></mujoco>"
        ));
        assert_eq!(messages, [] as [&str; 0]);
        let tree = |name: &str| scene.collision_root_of(named(&scene, name).handle());
        assert_eq!(tree("free"), named(&scene, "free").handle());
        assert_ne!(tree("carried"), named(&scene, "carried").handle());
    }

    #[test]
    fn what_has_no_counterpart_is_named() {
        let (_, messages) = imported(
            "<mujoco><worldbody><geom size='1'/>\n<flexcomp type='gmsh' file='a.msh'/></worldbody></mujoco>",
        );
        assert_eq!(
            messages,
            ["line 2, <flexcomp>: flexcomps of type 'gmsh' are not read"]
        );
    }
}
