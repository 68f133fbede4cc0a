import { useEffect } from "preact/hooks";

/** Shows the heading of a section of a document when the document or the section changes; "" is the start. */
export function useSection(text: string, section: string): void {
  useEffect(() => {
    const heading = section === "" ? null : document.getElementById(section);
    heading?.scrollIntoView();
    heading?.focus({ preventScroll: true });
    if (section === "") scrollTo(0, 0);
  }, [text, section]);
}
