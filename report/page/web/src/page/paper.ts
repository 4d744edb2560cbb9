/** The text width of A4 in px at 96 an inch, and that of one of two plots side by side. */
export const kPaperWidth = 680;
export const kHalfPaperWidth = 330;
