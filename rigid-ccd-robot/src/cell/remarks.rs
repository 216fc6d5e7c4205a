//! Remarks on a cell, and the sizes of its items.

use super::{Cell, Item};
use crate::remark::CellRemark;
use ccd_core::order::greater;
use rigid_ccd::text::RoundedToFourDigits;
use rigid_ccd::{Body, Remark};

impl Cell {
    /// Returns the remarks on the cell, warnings first. They are about the robot's files, about sizes that may be in
    /// another unit, such as millimetres instead of metres, and about pairs and items that are not checked.
    ///
    /// # Complexity
    /// Linear in the points of the robot's bodies, quadratic in the number of its links.
    pub fn remarks(&self) -> Vec<CellRemark> {
        let mut remarks = self.pairs.remarks(&self.robot);
        let bodies_with_size = (0..self.bodies.len()).filter(|&body| !self.is_plane(body));
        remarks.extend(
            bodies_with_size.filter_map(|body| match self.item_of_body(body) {
                Item::Link(_) => None,
                item => self.size_scale.remark(item.name(), self.bodies[body].sides),
            }),
        );
        remarks.extend(self.remark_on_static_items());
        let allowed = self.allowed_contacts().into_iter();
        let pairs = allowed.map(|pair| pair.map(|item| item.name().to_owned()));
        let pairs: Vec<[String; 2]> = pairs.collect();
        if !pairs.is_empty() {
            remarks.push(CellRemark::ContactsAllowed { pairs });
        }
        CellRemark::warnings_first(remarks)
    }

    /// Returns a remark if the robot has static bodies and the cell has obstacles. Static bodies and obstacles are not
    /// checked against each other.
    fn remark_on_static_items(&self) -> Option<CellRemark> {
        let mut items: Vec<String> = Vec::new();
        for body in (0..self.robot_body_count()).filter(|&body| !self.moves(body)) {
            let name = self.item_of_body(body).name();
            // Lists an item once, also if it has several bodies.
            if !items.iter().any(|item| item == name) {
                items.push(name.to_owned());
            }
        }
        let has_unchecked_pairs = !items.is_empty() && self.obstacle_names().len() > 0;
        has_unchecked_pairs.then_some(CellRemark::StaticItemsUnchecked { items })
    }

    /// Returns a remark if a body has an implausible size next to the robot. Call it before the body becomes an
    /// obstacle or is attached.
    ///
    /// # Complexity
    /// Linear in the points of the body.
    pub fn remark_on_size(&self, name: &str, body: &Body) -> Option<CellRemark> {
        self.size_scale.remark(name, Remark::sides(body))
    }

    /// Returns a remark if a tolerance is large compared with the smallest link, attached body or obstacle.
    ///
    /// # Complexity
    /// Constant, except for the first call after a change of the cell.
    pub fn remark_on_tolerance(&self, tolerance: f64) -> Option<CellRemark> {
        let find = || {
            let sizes = self.sizes_by_body().filter(|&(_, size)| size > 0.0);
            sizes.min_by(|(_, one), (_, other)| one.total_cmp(other))
        };
        let (body, size) = (*self.smallest_item.get_or_init(find))?;
        let remark = Remark::remark_on_tolerance(tolerance, [size; 2])?;
        Some(CellRemark::on(self.item_of_body(body).name(), remark))
    }

    /// Returns the size of each attached body, of each obstacle and of each link with bodies: the longest bounding-box
    /// side of its largest body. Planes have no size.
    pub fn item_sizes(&self) -> impl Iterator<Item = (Item<'_>, f64)> {
        let sizes = self.sizes_by_body();
        sizes.map(|(body, size)| (self.item_of_body(body), size))
    }

    /// Returns the sizes of the robot, the attached bodies and the obstacles as one line of text.
    pub fn sizes_text(&self) -> String {
        let robot = RoundedToFourDigits(self.robot.size().unwrap_or(0.0));
        let others = self.item_sizes().filter_map(|(item, size)| {
            let is_no_link = !matches!(item, Item::Link(_));
            is_no_link.then(|| format!(", {} {}", item.name(), RoundedToFourDigits(size)))
        });
        format!("robot {robot}{}", others.collect::<String>())
    }

    /// Returns the size of each item, with the index of its last body.
    fn sizes_by_body(&self) -> impl Iterator<Item = (usize, f64)> {
        let bodies_with_size = (0..self.bodies.len()).filter(|&body| !self.is_plane(body));
        let mut sizes = bodies_with_size
            .map(|body| {
                let sides = self.bodies[body].sides;
                (body, sides.into_iter().fold(0.0, greater))
            })
            .peekable();
        std::iter::from_fn(move || {
            let (mut last, mut largest) = sizes.next()?;
            // The bodies of one link are consecutive.
            let item = self.item_of_body(last);
            while let Some((body, size)) =
                sizes.next_if(|&(body, _)| self.item_of_body(body) == item)
            {
                (last, largest) = (body, greater(largest, size));
            }
            Some((last, largest))
        })
    }
}

#[cfg(test)]
mod tests;
