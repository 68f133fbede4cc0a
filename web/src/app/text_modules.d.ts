// figures.css as text, for exported files (build/bundle.mjs).
declare module "*.css?text" {
  const text: string;
  export default text;
}
