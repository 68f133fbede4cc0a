// All problems that the studio opens by name.

import { kGallery, type Problem } from "./gallery";
import { kPractice } from "./practice";

export const kProblems: readonly Problem[] = [...kGallery, ...kPractice];
