//! An environment as bytes, in a format of our own: a word of four letters, then counts and numbers in little-endian order. Counts are
//! compared with what is there before anything is allocated. Dependencies that are functions are not kept.

use geometry::pose::{pose_from_array, pose_to_array, quaternion_from_array, quaternion_to_array};

use crate::environment::Environment;
use crate::error::{KinematicsError, Result};
use crate::group::{Constraints, Element, Group, GroupFlags, Method};
use crate::joint::{Dependency, Joint, JointMode, JointType, Law};
use crate::object::{Kind, Object, ObjectId};

const MAGIC: &[u8; 4] = b"kin1";
const NONE: u32 = u32::MAX;

impl Environment {
    /// The whole environment as bytes, which [`Environment::read_bytes`] reads.
    ///
    /// # Errors
    /// When there are more than 2^32 objects.
    pub fn to_bytes(&self) -> Result<Vec<u8>> {
        let mut out = Writer(MAGIC.to_vec());
        out.count(self.objects.len())?;
        for object in &self.objects {
            out.flag(object.is_some());
            object.iter().try_for_each(|object| out.object(object))?;
        }
        out.count(self.groups.len())?;
        self.groups.iter().try_for_each(|group| out.group(group))?;
        Ok(out.0)
    }

    /// Replaces everything by what [`Environment::to_bytes`] wrote.
    ///
    /// # Errors
    /// When it did not.
    pub fn read_bytes(&mut self, bytes: &[u8]) -> Result<()> {
        let mut read = Environment::new(0);
        let mut input = Reader(bytes.strip_prefix(MAGIC).ok_or(KinematicsError::Damaged)?);
        input
            .environment(&mut read)
            .filter(|()| input.0.is_empty())
            .ok_or(KinematicsError::Damaged)?;
        read.is_consistent().ok_or(KinematicsError::Damaged)?;
        self.structure += 1;
        (self.objects, self.groups) = (read.objects, read.groups);
        let is_dependent = |object: &Object| {
            object
                .joint()
                .is_some_and(|joint| joint.dependency.is_some())
        };
        self.dependencies = self.objects.iter().flatten().any(is_dependent);
        Ok(())
    }

    /// Whether all references are to what they have to be, without circles; counts children.
    fn is_consistent(&mut self) -> Option<()> {
        let ids: Vec<ObjectId> = self.objects().map(|(id, _)| id).collect();
        for &id in &ids {
            let object = self.object(id).ok()?;
            let (parent, kind) = (object.parent, object.kind.clone());
            let mut above = parent;
            for _ in 0..=ids.len() {
                let Some(ancestor) = above else { break };
                above = self.object(ancestor).ok()?.parent;
            }
            if above.is_some() {
                return None;
            }
            match kind {
                Kind::Dummy {
                    partner: Some(partner),
                } => (self.partner(partner).ok()? == Some(id)).then_some(())?,
                Kind::Dummy { partner: None } => {}
                Kind::Joint(joint) => self.has_free_master(joint.dependency, ids.len())?,
            }
            if let Some(parent) = parent {
                self.objects[parent.0].as_mut()?.children += 1;
            }
        }
        for (_, element) in self.groups.iter().flat_map(Group::elements) {
            self.partner(element.tip).ok()?;
            [element.base, element.constraint_base]
                .into_iter()
                .flatten()
                .try_for_each(|id| self.object(id).map(drop))
                .ok()?;
        }
        Some(())
    }

    fn has_free_master(&self, dependency: Option<Dependency>, most: usize) -> Option<()> {
        let mut next = dependency.map(|dependency| dependency.master);
        for _ in 0..=most {
            let Some(master) = next else { return Some(()) };
            let joint = self.joint(master).ok()?;
            (joint.joint_type != JointType::Spherical).then_some(())?;
            next = joint
                .dependency
                .as_ref()
                .map(|dependency| dependency.master);
        }
        None
    }
}

struct Writer(Vec<u8>);

impl Writer {
    fn integer(&mut self, value: u32) {
        self.0.extend(value.to_le_bytes());
    }

    fn count(&mut self, count: usize) -> Result<()> {
        let count = u32::try_from(count)
            .ok()
            .filter(|count| *count < NONE)
            .ok_or(KinematicsError::TooLarge)?;
        self.integer(count);
        Ok(())
    }

    fn flag(&mut self, flag: bool) {
        self.0.push(flag.into());
    }

    fn numbers(&mut self, numbers: &[f64]) {
        numbers.iter().for_each(|x| self.0.extend(x.to_le_bytes()));
    }

    fn text(&mut self, text: &str) -> Result<()> {
        self.count(text.len())?;
        self.0.extend(text.as_bytes());
        Ok(())
    }

    fn reference(&mut self, id: Option<ObjectId>) -> Result<()> {
        match id {
            Some(id) => self.count(id.0),
            None => {
                self.integer(NONE);
                Ok(())
            }
        }
    }

    fn object(&mut self, object: &Object) -> Result<()> {
        self.text(&object.name)?;
        self.reference(object.parent)?;
        self.numbers(&pose_to_array(&object.pose));
        match &object.kind {
            Kind::Dummy { partner } => {
                self.integer(0);
                self.reference(*partner)
            }
            Kind::Joint(joint) => self.joint(joint),
        }
    }

    fn joint(&mut self, joint: &Joint) -> Result<()> {
        self.integer(joint.joint_type as u32);
        self.integer(joint.mode as u32);
        self.flag(joint.cyclic);
        self.numbers(&[joint.position, joint.min, joint.range, joint.screw_lead]);
        self.numbers(&[joint.weight, joint.max_step, joint.limit_margin]);
        self.numbers(&quaternion_to_array(&joint.rotation));
        match &joint.dependency {
            Some(Dependency {
                master,
                law: Law::Linear { offset, factor },
            }) => {
                self.reference(Some(*master))?;
                self.numbers(&[*offset, *factor]);
                Ok(())
            }
            _ => self.reference(None),
        }
    }

    fn group(&mut self, group: &Group) -> Result<()> {
        self.text(&group.name)?;
        [group.method as u32, group.iterations, group.flags.0]
            .into_iter()
            .for_each(|x| self.integer(x));
        self.numbers(&[group.damping]);
        self.count(group.elements.len())?;
        for element in &group.elements {
            self.flag(element.is_some());
            element
                .iter()
                .try_for_each(|element| self.element(element))?;
        }
        Ok(())
    }

    fn element(&mut self, element: &Element) -> Result<()> {
        self.flag(element.enabled);
        [Some(element.tip), element.base, element.constraint_base]
            .into_iter()
            .try_for_each(|id| self.reference(id))?;
        self.integer(element.constraints.0);
        self.numbers(&element.precision);
        self.numbers(&element.weights);
        Ok(())
    }
}

/// Reads from the front of bytes.
struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*first)
    }

    fn integer(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    /// How many things there are, each of at least one byte: they must be.
    fn count(&mut self) -> Option<usize> {
        self.integer()
            .map(|count| count as usize)
            .filter(|count| *count <= self.0.len())
    }

    fn flag(&mut self) -> Option<bool> {
        match self.take::<1>()? {
            [0] => Some(false),
            [1] => Some(true),
            _ => None,
        }
    }

    fn numbers<const N: usize>(&mut self) -> Option<[f64; N]> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = self
                .take()
                .map(f64::from_le_bytes)
                .filter(|x| x.is_finite())?;
        }
        Some(numbers)
    }

    fn text(&mut self) -> Option<String> {
        let count = self.count()?;
        let (text, rest) = self.0.split_at(count);
        self.0 = rest;
        String::from_utf8(text.to_vec()).ok()
    }

    fn reference(&mut self) -> Option<Option<ObjectId>> {
        let id = self.integer()?;
        Some((id != NONE).then_some(ObjectId(id as usize)))
    }

    fn environment(&mut self, env: &mut Environment) -> Option<()> {
        for _ in 0..self.count()? {
            let object = if self.flag()? {
                Some(self.object()?)
            } else {
                None
            };
            env.objects.push(object);
        }
        for _ in 0..self.count()? {
            let group = self.group()?;
            env.groups.push(group);
        }
        Some(())
    }

    fn object(&mut self) -> Option<Object> {
        let name = self.text()?;
        let parent = self.reference()?;
        let pose = pose_from_array(&self.numbers()?);
        let kind = match self.integer()? {
            0 => Kind::Dummy {
                partner: self.reference()?,
            },
            10 => Kind::Joint(self.joint(JointType::Revolute)?),
            11 => Kind::Joint(self.joint(JointType::Prismatic)?),
            12 => Kind::Joint(self.joint(JointType::Spherical)?),
            _ => return None,
        };
        Some(Object {
            name,
            parent,
            pose,
            kind,
            children: 0,
        })
    }

    fn joint(&mut self, joint_type: JointType) -> Option<Joint> {
        let mode = match self.integer()? {
            0 => JointMode::Passive,
            2 => JointMode::Ik,
            _ => return None,
        };
        let cyclic = self.flag()?;
        let [position, min, range, screw_lead] = self.numbers()?;
        let [weight, max_step, limit_margin] = self.numbers()?;
        let rotation = quaternion_from_array(&self.numbers()?);
        let dependency = match self.reference()? {
            Some(master) => {
                let [offset, factor] = self.numbers()?;
                Some(Dependency {
                    master,
                    law: Law::Linear { offset, factor },
                })
            }
            None => None,
        };
        let numbers = Joint {
            position,
            min,
            range,
            screw_lead,
            weight,
            max_step,
            limit_margin,
            ..Joint::new(joint_type)
        };
        Some(Joint {
            mode,
            rotation,
            cyclic,
            dependency,
            ..numbers
        })
    }

    fn group(&mut self) -> Option<Group> {
        let mut group = Group::new(&self.text()?);
        group.method = Method::from_raw(self.integer()?.into())?;
        group.iterations = self.integer()?;
        group.flags = GroupFlags(self.integer()?);
        [group.damping] = self.numbers()?;
        for _ in 0..self.count()? {
            let element = if self.flag()? {
                Some(self.element()?)
            } else {
                None
            };
            group.elements.push(element);
        }
        Some(group)
    }

    fn element(&mut self) -> Option<Element> {
        let enabled = self.flag()?;
        let tip = self.reference()??;
        let (base, constraint_base) = (self.reference()?, self.reference()?);
        let constraints = Constraints(self.integer()?);
        let (precision, weights) = (self.numbers()?, self.numbers()?);
        Some(Element {
            enabled,
            tip,
            base,
            constraint_base,
            constraints,
            precision,
            weights,
        })
    }
}
