//! Drawing objects: points, lines, triangles and small bodies that scripts draw (spec: sensors 6). They are seen by cameras and vision
//! sensors, and are no objects of the tree: handles of their own, not saved.

mod container;
mod items;
pub mod options;
pub mod particles;

use nalgebra::Point3;

use super::appearance::colour::Colour;
use super::{Handle, Pose};
use items::Items;
use options::{DrawingFlags, DrawingKind};

pub use container::Drawings;
pub use items::DrawingItem;

/// Appearance and capacity of a drawing object.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawingStyle {
    /// What the items are.
    pub kind: DrawingKind,
    /// How items are stored and drawn.
    pub flags: DrawingFlags,
    /// Width of points and lines in pixels, of other items in metres.
    pub size: f64,
    /// An item nearer than this to another one is refused, metres; 0 accepts all.
    pub duplicate_tolerance: f64,
    /// The object that the items move with; None for the world.
    pub parent: Option<Handle>,
    /// Capacity; see [`DrawingFlags::CYCLIC`] for what a full object does.
    pub max_items: usize,
    /// Colour of items without a colour of their own.
    pub colour: Colour,
}

/// Items of one kind that a script draws.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawingObject {
    /// Appearance and capacity.
    pub style: DrawingStyle,
    /// The script whose end removes it.
    owner: Option<i64>,
    items: Items,
    changed_at: u64,
}

impl DrawingObject {
    /// Largest capacity, whatever a script asks for.
    const MAX_ITEMS: usize = 10_000_000;

    fn new(mut style: DrawingStyle, owner: Option<i64>) -> Self {
        style.max_items = style.max_items.clamp(1, Self::MAX_ITEMS);
        let owner = owner.filter(|_| !style.flags.contains(DrawingFlags::PERSISTENT));
        Self {
            items: Items::new(style.kind, style.flags),
            style,
            owner,
            changed_at: 0,
        }
    }

    /// Number of its last change, among those of all drawing objects of the scene.
    pub fn changed_at(&self) -> u64 {
        self.changed_at
    }

    /// Numbers per item: coordinates, the normal, then colours, size and transparency where the type has them.
    pub fn item_len(&self) -> usize {
        self.items.item_len()
    }

    /// The items in the frame of the parent, the oldest first.
    pub fn items(&self) -> impl Iterator<Item = DrawingItem<'_>> {
        self.items.iter()
    }

    /// Adds the item at the beginning of `numbers`, given in the frame `parent` maps to. False when there is no room or an equal item,
    /// or when there are too few numbers.
    pub(crate) fn add(&mut self, numbers: &[f64], parent: &Pose) -> bool {
        let Some(numbers) = numbers.get(..self.item_len()) else {
            return false;
        };
        if !numbers.iter().all(|number| number.is_finite()) {
            return false;
        }
        let mut item = numbers.to_vec();
        if !self.style.flags.contains(DrawingFlags::LOCAL) {
            self.make_local(&mut item, parent);
        }
        if self.items.has_near(&item, self.style.duplicate_tolerance) {
            return false;
        }
        self.items.push(
            &item,
            self.style.max_items,
            self.style.flags.contains(DrawingFlags::CYCLIC),
        )
    }

    fn make_local(&self, item: &mut [f64], parent: &Pose) {
        let (points, rest) = item.split_at_mut(3 * self.style.kind.points());
        for point in points.as_chunks_mut::<3>().0 {
            *point = parent.inverse_transform_point(&Point3::from(*point)).into();
        }
        if self.items.has_normal()
            && let Some(normal) = rest.first_chunk_mut::<3>()
        {
            *normal = parent.inverse_transform_vector(&(*normal).into()).into();
        }
    }

    /// Removes all items.
    pub(crate) fn clear(&mut self) {
        self.items.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawing(kind: DrawingKind, flags: DrawingFlags, max_items: usize) -> DrawingObject {
        let colour = Colour::new([1.0; 3]);
        let style = DrawingStyle {
            kind,
            flags,
            size: 1.0,
            duplicate_tolerance: 0.0,
            parent: None,
            max_items,
            colour,
        };
        DrawingObject::new(style, None)
    }

    fn points(drawing: &DrawingObject) -> Vec<[f64; 3]> {
        drawing
            .items()
            .flat_map(|item| item.points().to_vec())
            .collect()
    }

    #[test]
    fn a_full_object_refuses_and_a_cyclic_one_replaces_the_oldest() {
        let mut plain = drawing(DrawingKind::Points, DrawingFlags::empty(), 2);
        let mut cyclic = drawing(DrawingKind::Points, DrawingFlags::CYCLIC, 2);
        let add = |to: &mut DrawingObject| {
            (0..3)
                .map(|i| to.add(&[f64::from(i), 0.0, 0.0], &Pose::identity()))
                .collect()
        };
        let (added, replaced): (Vec<bool>, Vec<bool>) = (add(&mut plain), add(&mut cyclic));
        assert_eq!((added, replaced), (vec![true, true, false], vec![true; 3]));
        assert_eq!(points(&plain), [[0.0; 3], [1.0, 0.0, 0.0]]);
        assert_eq!(points(&cyclic), [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]);
        plain.clear();
        assert!(points(&plain).is_empty() && plain.add(&[5.0; 3], &Pose::identity()));
    }

    #[test]
    fn items_are_stored_in_the_frame_of_the_parent() {
        let parent = Pose::translation(1.0, 0.0, 0.0);
        let mut world = drawing(DrawingKind::QuadPoints, DrawingFlags::empty(), 9);
        assert!(world.add(&[1.0, 2.0, 3.0, 0.0, 0.0, 1.0], &parent));
        let item = world.items().next().unwrap();
        assert_eq!(
            (item.points(), item.normal()),
            (&[[0.0, 2.0, 3.0]][..], Some([0.0, 0.0, 1.0]))
        );
        let mut local = drawing(DrawingKind::Points, DrawingFlags::LOCAL, 9);
        assert!(local.add(&[1.0, 2.0, 3.0], &parent));
        assert_eq!(points(&local), [[1.0, 2.0, 3.0]]);
    }

    #[test]
    fn what_is_no_item_is_refused() {
        let mut lines = drawing(DrawingKind::Lines, DrawingFlags::empty(), 9);
        assert!(!lines.add(&[0.0; 5], &Pose::identity()));
        assert!(!lines.add(&[0.0, 0.0, f64::NAN, 0.0, 0.0, 0.0], &Pose::identity()));
        assert!(lines.add(&[0.0; 6], &Pose::identity()));
    }

    #[test]
    fn items_have_colours_sizes_and_transparency_of_their_own() {
        let flags =
            DrawingFlags::ITEM_COLOURS | DrawingFlags::ITEM_SIZES | DrawingFlags::ITEM_TRANSPARENCY;
        let mut spheres = drawing(DrawingKind::SpherePoints, flags, 9);
        assert_eq!(spheres.item_len(), 8);
        assert!(spheres.add(
            &[0.0, 0.0, 0.0, 1.0, 0.5, 0.0, 0.2, 0.25],
            &Pose::identity()
        ));
        let item = spheres.items().next().unwrap();
        assert_eq!(
            (item.colours(), item.size(), item.transparency()),
            (&[[1.0, 0.5, 0.0]][..], Some(0.2), Some(0.25))
        );
    }
}
