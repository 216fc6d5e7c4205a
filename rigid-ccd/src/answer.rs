//! The types within an [`Answer`](crate::Answer), and the pairs of features that
//! [`Query::contacts_at`](crate::Query::contacts_at) lists.

pub use crate::parallel::QueryError;
pub use ccd_core::{
    ClearanceVerdict, Contact, ContactsError, Feature, HitKind, Limit, Overlap, Stats, Unresolved,
};
