//! The features in contact that [`Query::contacts_at`](crate::Query::contacts_at) lists.

pub use ccd_core::{ContactsError, Feature, FeaturePair};
