//! Reads glTF accessors: typed arrays in buffers.

use super::buffers::Buffers;
use super::element_at_index;
use super::schema::{self, Root, Sparse};
use crate::mesh::content::allowance::{ExpansionBudget, expansion_cost};
use crate::mesh::error::{MeshFault, element_name};
use ccd_core::glam::DVec3;
use ccd_core::order::greater;

/// A reader of accessors, which charges their elements to the file's expansion budget.
pub(super) struct AccessorReader<'a> {
    pub(super) root: &'a Root,
    pub(super) buffers: &'a Buffers<'a>,
    pub(super) expansion_budget: ExpansionBudget,
}

/// A component type of glTF accessors.
struct ComponentType {
    bytes_per_component: usize,
    /// The largest value of an integer type, by which a normalized integer is divided; `None` for floats.
    max_integer: Option<f64>,
    /// Reads a number from the first bytes of a slice.
    read: fn(&[u8]) -> f64,
}

impl<'a> AccessorReader<'a> {
    /// Returns whether an accessor can be read without a compression extension.
    pub(super) fn has_uncompressed_data(&self, accessor: usize) -> bool {
        let about = self.root.accessors.get(accessor);
        about.is_some_and(|about| about.buffer_view.is_some() || about.sparse.is_some())
    }

    /// Spends the cost of `count` face corners from the expansion budget.
    pub(super) fn spend_corners(&mut self, count: usize) -> Result<(), MeshFault> {
        self.expansion_budget.spend(expansion_cost(0, count as u64))
    }

    /// Reads the points of a `VEC3` accessor as f64.
    pub(super) fn points(&mut self, accessor: usize) -> Result<Vec<DVec3>, MeshFault> {
        self.with_accessor_context(accessor, |accessors, about| {
            check_accessor_type(about, "VEC3")?;
            let component = ComponentType::from_code(about.component_type)?;
            let size = component.bytes_per_component;
            let largest = component.max_integer.filter(|_| about.normalized);
            let point = |row: &[u8]| {
                let numbers = [0, 1, 2].map(|k| (component.read)(&row[k * size..]));
                DVec3::from_array(match largest {
                    Some(largest) => numbers.map(|number| greater(number / largest, -1.0)),
                    None => numbers,
                })
            };
            let price = expansion_cost(about.count, 0);
            accessors.read_elements(about, 3 * size, price, DVec3::ZERO, point)
        })
    }

    /// Reads the indices of a `SCALAR` accessor.
    pub(super) fn indices(&mut self, accessor: usize) -> Result<Vec<u32>, MeshFault> {
        self.with_accessor_context(accessor, |accessors, about| {
            check_accessor_type(about, "SCALAR")?;
            let component = ComponentType::index_type_from_code(about.component_type)?;
            let whole = |row: &[u8]| (component.read)(row) as u32;
            let price = expansion_cost(0, about.count);
            accessors.read_elements(about, component.bytes_per_component, price, 0, whole)
        })
    }

    /// Calls `read` with an accessor's description, and adds the accessor's number to its faults.
    fn with_accessor_context<T>(
        &mut self,
        accessor: usize,
        read: impl FnOnce(&mut Self, &schema::Accessor) -> Result<T, MeshFault>,
    ) -> Result<T, MeshFault> {
        let about = element_at_index(&self.root.accessors, "accessor", accessor)?;
        read(self, about)
            .map_err(|fault| fault.at_element(element_name("accessor", accessor, None)))
    }

    /// Reads all elements of an accessor, including those that its sparse part replaces.
    fn read_elements<T: Clone>(
        &mut self,
        about: &schema::Accessor,
        size: usize,
        price: u64,
        zero: T,
        read: impl Fn(&[u8]) -> T,
    ) -> Result<Vec<T>, MeshFault> {
        let rows = match about.buffer_view {
            Some(view) => {
                let stride = self.buffers.stride(view);
                let layout = (about.count, size);
                Some(self.element_slices(view, about.byte_offset, layout, stride)?)
            }
            None if about.sparse.is_some() => None,
            None => return Err(MeshFault::malformed_content("has no buffer view")),
        };
        self.expansion_budget.spend(price)?;
        let mut elements: Vec<T> = match rows {
            Some(rows) => rows.map(&read).collect(),
            // All except the sparse elements are zero. The allowance bounds the number.
            None => vec![zero; about.count as usize],
        };
        if let Some(sparse) = &about.sparse {
            let places = self.sparse_indices(sparse, elements.len())?;
            let values = &sparse.values;
            let layout = (sparse.count, size);
            let values =
                self.element_slices(values.buffer_view, values.byte_offset, layout, None)?;
            for (place, row) in places.into_iter().zip(values) {
                elements[place] = read(row);
            }
        }
        Ok(elements)
    }

    /// Returns an iterator over the bytes of each of `count` elements of `size` bytes, at a constant stride in a buffer
    /// view.
    fn element_slices(
        &self,
        view: usize,
        offset: u64,
        (count, size): (u64, usize),
        stride: Option<u64>,
    ) -> Result<impl Iterator<Item = &'a [u8]> + use<'a>, MeshFault> {
        let bytes = self.buffers.view_bytes(view, offset)?;
        let stride = stride.unwrap_or(size as u64);
        if stride < size as u64 {
            let problem = format!("has elements of {size} bytes every {stride} bytes");
            return Err(MeshFault::malformed_content(problem));
        }
        let before_last = stride.checked_mul(count.saturating_sub(1));
        let end = before_last.and_then(|before| before.checked_add(size as u64));
        if count > 0 && end.is_none_or(|end| end > bytes.len() as u64) {
            let missing = format!("all {count} elements of {size} bytes in buffer view {view}");
            return Err(MeshFault::truncated_file(missing));
        }
        // All elements are within the bytes.
        Ok((0..count as usize).map(move |k| &bytes[k * stride as usize..][..size]))
    }

    /// Reads the indices of the elements that a sparse accessor replaces, each below `length`.
    fn sparse_indices(&mut self, sparse: &Sparse, length: usize) -> Result<Vec<usize>, MeshFault> {
        let about = &sparse.indices;
        let component = ComponentType::index_type_from_code(about.component_type)?;
        let layout = (sparse.count, component.bytes_per_component);
        let rows = self.element_slices(about.buffer_view, about.byte_offset, layout, None)?;
        self.expansion_budget
            .spend(expansion_cost(0, sparse.count))?;
        let checked = |row| match (component.read)(row) as usize {
            number if number < length => Ok(number),
            number => Err(MeshFault::malformed_content(format!(
                "replaces element {number} of {length}"
            ))),
        };
        rows.map(checked).collect()
    }
}

fn check_accessor_type(about: &schema::Accessor, kind: &str) -> Result<(), MeshFault> {
    if about.kind == kind {
        Ok(())
    } else {
        let problem = format!("is of type {:?} instead of {kind}", about.kind);
        Err(MeshFault::malformed_content(problem))
    }
}

impl ComponentType {
    fn from_code(number: u32) -> Result<Self, MeshFault> {
        macro_rules! integer {
            ($type:ty) => {
                ComponentType {
                    bytes_per_component: size_of::<$type>(),
                    max_integer: Some(<$type>::MAX.into()),
                    read: |bytes| <$type>::from_le_bytes(first_bytes_or_zeros(bytes)).into(),
                }
            };
        }
        Ok(match number {
            5120 => integer!(i8),
            5121 => integer!(u8),
            5122 => integer!(i16),
            5123 => integer!(u16),
            5125 => integer!(u32),
            5126 => ComponentType {
                bytes_per_component: 4,
                max_integer: None,
                read: |bytes| f32::from_le_bytes(first_bytes_or_zeros(bytes)).into(),
            },
            _ => {
                let problem = format!("has components of type {number}, which there is not");
                return Err(MeshFault::malformed_content(problem));
            }
        })
    }

    /// Returns the unsigned integer type with a given glTF code, for vertex indices; other types are a fault.
    fn index_type_from_code(number: u32) -> Result<Self, MeshFault> {
        match (number, ComponentType::from_code(number)?) {
            (5121 | 5123 | 5125, unsigned) => Ok(unsigned),
            _ => Err(MeshFault::malformed_content(format!(
                "has components of type {number} instead of whole numbers"
            ))),
        }
    }
}

/// Returns the first `N` bytes of a slice, or `N` zeros if there are too few.
fn first_bytes_or_zeros<const N: usize>(bytes: &[u8]) -> [u8; N] {
    bytes.first_chunk().copied().unwrap_or([0; N])
}
