//! The content of a file, in file order: objects, their geometry, and the rest of the top level.

use super::chunks::{
    Camera, Collection, Collision, Common, CustomData, CustomObjects, CustomSceneObject, Distance,
    Dummy, Dynamics, Environment, ForceSensor, Ghosts, Graph, IkGroup, Joint, Light, Marker,
    Material, MeshData, MeshNode, MeshPool, Mill, Mirror, ModelInfo, ModuleSettings, OcTree,
    OldCustomData, Path, PathPlanning, PointCloud, ProximitySensor, Script, ScriptObject, Shape,
    Simulation, Texture, Thumbnail, Views, VisionSensor,
};
use super::error::FileResult;
use super::node::{Node, NodeResult, at};
use super::read::{Reader, Real, Tag};
use super::stream::{Stream, entries_of, streams};
use super::value::{Rest, Value};
use super::write::Writer;
use crate::ttt::chunks::ButtonBlock;

/// A mesh: a node of the tree, and its triangles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    pub node: MeshNode,
    pub data: MeshData,
}

impl Value for Mesh {
    fn read(input: &mut Reader<'_>, _: Real) -> FileResult<Self> {
        Ok(Self {
            node: MeshNode::read_stream(input)?,
            data: MeshData::read_stream(input)?,
        })
    }

    fn write(&self, out: &mut Writer) {
        self.node.write_stream(out);
        self.data.write_stream(out);
    }

    fn to_node(&self) -> Node {
        Node::table([("node", self.node.to_node()), ("mesh", self.data.to_node())])
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        Ok(Self {
            node: Value::from_node(node.need("node")?)?,
            data: Value::from_node(node.need("mesh")?)?,
        })
    }
}

/// A child of a group of meshes.
#[derive(Debug, Clone, PartialEq)]
pub enum MeshTree {
    Mesh(Box<Mesh>),
    Group(Box<MeshNode>),
}

impl Value for MeshTree {
    fn read(input: &mut Reader<'_>, real: Real) -> FileResult<Self> {
        Ok(match &input.tag() {
            b"Wrp" => Self::Group(Value::read(input, real).map(Box::new)?),
            _ => Self::Mesh(Value::read(input, real).map(Box::new)?),
        })
    }

    fn write(&self, out: &mut Writer) {
        match self {
            Self::Mesh(mesh) => mesh.write(out),
            Self::Group(group) => group.write(out),
        }
    }

    fn tag(&self, _: Tag) -> Tag {
        match self {
            Self::Mesh(_) => *b"Geo",
            Self::Group(_) => *b"Wrp",
        }
    }

    fn to_node(&self) -> Node {
        match self {
            Self::Mesh(mesh) => mesh.to_node(),
            Self::Group(group) => Node::table([("group", group.to_node())]),
        }
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        Ok(match node.get("group") {
            Some(group) => Self::Group(Box::new(Value::from_node(group)?)),
            None => Self::Mesh(Box::new(Value::from_node(node)?)),
        })
    }
}

/// A scene object: what all have, and what its type adds.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    /// Where its chunk begins in the uncompressed body.
    pub offset: usize,
    pub common: Common,
    pub class: Class,
}

macro_rules! classes {
    ($($name:ident = $tag:literal,)*) => {
        /// The type of an object, with what only this type has.
        #[derive(Debug, Clone, PartialEq)]
        pub enum Class {
            $($name(Box<$name>),)*
            /// A type of a later program: the object keeps its place in the tree, the rest is not understood.
            Unknown(Tag),
        }

        impl Class {
            fn read(input: &mut Reader<'_>) -> FileResult<Self> {
                Ok(match &input.tag() {
                    $($tag => Self::$name(Box::new(Stream::read_stream(input)?)),)*
                    other => {
                        input.skip();
                        input.take_rest();
                        Self::Unknown(*other)
                    }
                })
            }

            fn write(&self, out: &mut Writer) {
                match self {
                    $(Self::$name(class) => class.write_stream(out),)*
                    Self::Unknown(_) => out.end(*b"EOO"),
                }
            }

            pub fn tag(&self) -> Tag {
                match self {
                    $(Self::$name(_) => *$tag,)*
                    Self::Unknown(tag) => *tag,
                }
            }

            /// The name of the type, and what it has.
            fn entry(&self) -> (&'static str, Node) {
                match self {
                    $(Self::$name(class) => (stringify!($name), class.to_node()),)*
                    Self::Unknown(tag) => ("Unknown", Node::Bytes(tag.to_vec())),
                }
            }

            fn of_entry(name: &str, node: &Node) -> NodeResult<Self> {
                Ok(match name {
                    $(stringify!($name) => Self::$name(Box::new(at(name, Value::from_node(node))?)),)*
                    "Unknown" => Self::Unknown(node.bytes()?.try_into().map_err(|_| "a tag has three letters")?),
                    _ => return Err(format!("`{name}` is no type of objects")),
                })
            }
        }
    };
}

classes! {
    Shape = b"SHP",
    Joint = b"JNT",
    Graph = b"GRH",
    Camera = b"CMA",
    Light = b"LGT",
    Mirror = b"MIR",
    OcTree = b"OCT",
    PointCloud = b"PTC",
    Dummy = b"DMY",
    Marker = b"MKR",
    CustomSceneObject = b"CSO",
    ScriptObject = b"SCT",
    ProximitySensor = b"SNR",
    VisionSensor = b"RSN",
    Path = b"PAT",
    Mill = b"MIL",
    ForceSensor = b"FSE",
}

impl Value for Object {
    fn read(input: &mut Reader<'_>, _: Real) -> FileResult<Self> {
        let offset = input.offset();
        Ok(Self {
            offset,
            common: Common::read_stream(input)?,
            class: Class::read(input)?,
        })
    }

    fn write(&self, out: &mut Writer) {
        self.common.write_stream(out);
        self.class.write(out);
    }

    fn tag(&self, _: Tag) -> Tag {
        self.class.tag()
    }

    fn to_node(&self) -> Node {
        Node::table([("Object", self.common.to_node()), self.class.entry()])
    }

    fn from_node(node: &Node) -> NodeResult<Self> {
        let common = at("Object", Value::from_node(node.need("Object")?))?;
        let class = entries_of(node)?
            .iter()
            .find(|(name, _)| name != "Object")
            .ok_or("the type of an object is missing")?;
        Ok(Self {
            offset: 0,
            common,
            class: Class::of_entry(&class.0, &class.1)?,
        })
    }
}

streams! {
    /// All of a scene or model.
    Contents until b"EOF" {
        thumbnail: Option<Thumbnail> = b"MTC",
        /// Of models only.
        model_info: Option<ModelInfo> = b"BBC",
        /// Thumbnail before 2012.
        old_thumbnail: Option<Rest<u8>> = b"MTB",
        /// Acknowledgment of a model before 2010.
        old_acknowledgment: Option<Rest<u8>> = b"MAC",
        textures: Vec<Texture> = b"TEX",
        /// Materials by number, for files before 3.3.3.
        materials: Vec<Material> = b"DMA",
        mesh_pool: Option<MeshPool> = b"VIN",
        objects: Vec<Object> = b"SHP" | b"JNT" | b"GRH" | b"CMA" | b"LGT" | b"MIR" | b"OCT" | b"PTC" | b"DMY" | b"MKR" | b"CSO" | b"SCT" | b"SNR" | b"RSN" | b"PAT" | b"MIL" | b"FSE",
        ghosts: Option<Ghosts> = b"GHO",
        module_settings: Option<ModuleSettings> = b"SET",
        environment: Option<Environment> = b"ENV",
        collisions: Vec<Collision> = b"COL",
        distances: Vec<Distance> = b"DST",
        ik_groups: Vec<IkGroup> = b"IKO",
        path_planning: Vec<PathPlanning> = b"PPL",
        /// Handles in the order of display, until 3.6.1.
        object_order: Option<Rest<i32>> = b"ORD",
        /// Motion planning tasks, removed in 4.0.
        motion_planning: Vec<Rest<u8>> = b"MPL",
        /// Solvers of geometric constraints, removed.
        geometric_constraints: Vec<Rest<u8>> = b"GCO",
        /// Geometry before serialization 16.
        old_geometry: Vec<Rest<u8>> = b"GEO",
        dynamics: Option<Dynamics> = b"DYN",
        simulation: Option<Simulation> = b"SIM",
        custom_data: Option<CustomData> = b"CDA",
        custom_objects: Option<CustomObjects> = b"COB",
        old_custom_data: Option<OldCustomData> = b"CDS",
        views: Option<Views> = b"VEW",
        collections: Vec<Collection> = b"GRP",
        button_blocks: Vec<ButtonBlock> = b"BBK",
        /// Scripts outside of the tree: the main script, and those attached to objects.
        scripts: Vec<Script> = b"LST",
    }
}
